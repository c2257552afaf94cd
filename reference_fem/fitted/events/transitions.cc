#include <reference_fem/fitted/events/profile.h>
#include <reference_fem/fitted/events/transitions.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using cases::BoundaryKind;
    using dealii::Vector;

    /** How long after the crossing a front is seeded, of the time that is left. */
    constexpr double late_share = 1e-5;

    /** The same, of the time that the wall took to get there: for so long its
     * temperature is a ramp. */
    constexpr double ramp_share = 1e-2;

    constexpr double growth_of_steps = 2;

    /** Cells next to a wall in the thermal layer that forms before a front starts, and
     * steps of that time's double. */
    constexpr double cells_in_layer = 2;
    constexpr int steps_to_passing = 28;

    /** Secant steps for the front's place: its heat is all but linear in it. */
    constexpr int balance_steps = 6;

    HeatContent sum_of(const HeatContent &a, const HeatContent &b)
    {
      return {a.sensible + b.sensible, a.latent + b.latent, a.walls + b.walls,
              a.sources + b.sources};
    }

    /** i^2erfc, the second integral of the complementary error function. */
    double second_integral(const double x)
    {
      return 0.25
             * ((1 + 2 * x * x) * std::erfc(x)
                - 2 * x * std::exp(-x * x) / std::sqrt(std::numbers::pi));
    }

    Physics one_phase_physics(const EventScene &setting, const bool solid)
    {
      Physics physics = physics_of(setting.scene, setting.effects, setting.options, true);
      if(!solid)
        std::swap(physics.phases[0], physics.phases[1]);
      // Liquid moves only where a front makes it.
      physics.displacement = 0;
      return physics;
    }
  } // namespace

  RunSegment one_phase_stretch(const EventScene &setting)
  {
    const cases::Scene &scene = setting.scene;
    const RayScene &rays = setting.rays;
    const RayMesh mesh(rays.surface, rays.inner, rays.outer,
                       graded_shares(rays.cells, 1, true));
    Physics physics = one_phase_physics(setting, initial_front(scene, rays).solid_inside);
    physics.clock = {};
    // A sink makes a front at once: this is the state before it is switched on.
    physics.power = {};
    RunSegment result;
    result.problem = std::make_shared<FittedProblem>(mesh, physics);
    result.time = scene.start_time;
    result.state
        = result.problem->state(scene.start_time, {},
                                [&](const cases::Position &p) {
                                  return scene.initial.temperature(p, scene.start_time);
                                });
    result.steps = {{scene.end_time, (scene.end_time - scene.start_time)
                                         / std::max(1, setting.options.steps)}};
    return result;
  }

  RunSegment refined_stretch(const EventScene &setting, const RunSegment &segment,
                             const bool inner, const double soon)
  {
    const FittedProblem &old = *segment.problem;
    const RayMesh &mesh = old.mesh();
    const Phase &phase = old.physics().phases[0];
    const double length = mesh.outer - mesh.inner;
    const double layer = std::sqrt(phase.conductivity / phase.capacity * soon)
                         / (cells_in_layer * length);
    std::vector<double> shares;
    for(const Layer &cells : mesh.layers)
      shares.push_back((cells.fixed[0] - mesh.inner) / length);
    shares.push_back(1);
    // From the wall on, as distances.
    if(!inner)
      std::ranges::reverse(shares);
    while(std::abs(shares[1] - shares[0]) > layer)
      shares.insert(shares.begin() + 1, 0.5 * (shares[0] + shares[1]));
    if(!inner)
      std::ranges::reverse(shares);

    Physics physics = old.physics();
    physics.clock = {true, segment.time};
    RunSegment result;
    result.problem = std::make_shared<FittedProblem>(
        RayMesh(mesh.surface, mesh.inner, mesh.outer, shares), physics);
    result.time = segment.time;
    const Profile profile(old, segment.state);
    result.state
        = result.problem->state(segment.time, {},
                                [&](const cases::Position &p)
                                {
                                  const double r = setting.scene.domain.round()
                                                       ? std::hypot(p[0], p[1], p[2])
                                                       : p[0];
                                  return physics.melting_temperature + profile.value(r);
                                });
    const HeatContent before = old.heat(segment.time, segment.state);
    result.before = sum_of(segment.before, {0, 0, before.walls, before.sources});
    const double early = std::min(physics.clock.clock(segment.time + 2 * soon),
                                  physics.clock.clock(setting.scene.end_time));
    const double end = physics.clock.clock(setting.scene.end_time);
    const int steps = steps_for(setting, segment.time);
    result.steps = {{early, early / std::max(steps_to_passing, steps / 2)}};
    if(early < end)
      for(const StepRange &range : lengthening_steps(early, end, steps, growth_of_steps))
        result.steps.push_back(range);
    result.event
        = {segment.time, fmt::format("cells and steps are drawn to the wall {}, which is "
                                     "about to pass the melting temperature",
                                     to_string(side_at(setting.scene, inner)))};
    return result;
  }

  double time_of_seed(const EventScene &setting, const RunSegment &past,
                      const double crossing)
  {
    return std::min({late_share * (setting.scene.end_time - crossing),
                     ramp_share * (crossing - past.time),
                     0.5 * time_to_breakpoint(setting.scene, crossing)});
  }

  RunSegment late_stretch(const EventScene &setting, const RunSegment &past,
                          const double crossing, const Vector<double> &u,
                          const bool inner, const IntegrationOptions &integration)
  {
    const cases::Scene &scene = setting.scene;
    const RayScene &rays = setting.rays;
    const Physics &old = past.problem->physics();
    const double since = time_of_seed(setting, past, crossing);
    const double time = crossing + since;

    if(old.power)
      throw cases::Refusal(fmt::format(
          "fem-fitted follows one front beside a source; at t = {:.6g} a wall passes the "
          "melting temperature",
          crossing));
    Integrator beyond(*past.problem, integration);
    beyond.start(old.clock.clock(crossing), u);
    beyond.advance_to(old.clock.clock(time), scene.end_time);
    const Profile profile(*past.problem, beyond.state());
    const double wall = inner ? rays.inner : rays.outer;
    const double excess = past.problem->wall_excess(inner, 0, time, beyond.state());
    const Phase &phase = old.phases[0];
    const bool new_is_solid = !phase.solid;
    if((excess < 0) != new_is_solid || excess == 0)
      throw cases::NumericalError(integration.method, 0, time, "the wall",
                                  "turned back from the melting temperature at once");

    Physics physics
        = physics_of(scene, setting.effects, setting.options, inner == new_is_solid);
    physics.clock = {true, crossing};
    const Phase &new_phase = physics.phases[inner ? 0 : 1];
    const double latent
        = scene.material.latent_heat
          * (new_is_solid ? scene.material.solid.density : scene.material.liquid.density);
    const double diffusivity = phase.conductivity / phase.capacity;
    const double layer = 2 * std::sqrt(diffusivity * since);
    RunSegment result;
    result.problem
        = std::make_shared<FittedProblem>(seed_mesh(rays, inner, layer, 0), physics);
    result.time = time;

    // Everything by distance from the wall; positive slopes lead away from it.
    const cases::Boundary &wall_law = inner ? old.inner_wall : old.outer_wall;
    const double outflow = phase.conductivity * profile.slope(wall) * (inner ? 1 : -1);
    const double rate = std::abs(excess) / since;
    const double direction = new_is_solid ? 1 : -1;
    const bool held = wall_law.kind == BoundaryKind::fixed_temperature;
    double width = 4. / 3 * phase.conductivity * std::abs(excess) * std::sqrt(since)
                   / (latent * std::sqrt(std::numbers::pi * diffusivity));
    if(held)
      width = since
              * (std::sqrt(std::pow(outflow, 2)
                           + 4 * latent * new_phase.conductivity * rate)
                 - direction * outflow)
              / (2 * latent);
    const RayMesh &mesh = result.problem->mesh();
    const double gradient
        = held ? -excess / width
               : -cases::heat_through(wall_law, mesh.position(0, wall), time,
                                      scene.material.melting_temperature)
                         .flux
                     / new_phase.conductivity;
    const auto state_with = [&](const double front)
    {
      return result.problem->state(
          time, {inner ? wall + front : wall - front},
          [&](const cases::Position &p)
          {
            const double r = scene.domain.round() ? std::hypot(p[0], p[1], p[2]) : p[0];
            const double distance = std::abs(r - wall);
            const double above
                = distance < front
                      ? gradient * (distance - front)
                      : profile.value(r) - 4 * excess * second_integral(distance / layer);
            return scene.material.melting_temperature + above;
          });
    };
    const HeatContent before = past.problem->heat(time, beyond.state());
    const auto surplus = [&](const Vector<double> &state)
    {
      const HeatContent now = result.problem->heat(time, state);
      return now.sensible + now.latent - before.sensible - before.latent;
    };
    result.state = state_with(width);
    const double area = std::pow(wall, rays.surface.exponent)
                        * (rays.surface.exponent == 0   ? 1
                           : rays.surface.exponent == 1 ? 2 * std::numbers::pi
                                                        : 4 * std::numbers::pi);
    for(int step = 0; !held && step < balance_steps; ++step)
    {
      width += direction * surplus(result.state) / (latent * area);
      if(!(width > 0))
        throw cases::Refusal(
            fmt::format("{} cannot start a front at the wall {} at t = {:.6g}: no place "
                        "of it balances "
                        "the heat of its cells there; more cells would help",
                        integration.method, to_string(side_at(scene, inner)), time));
      result.state = state_with(width);
    }
    result.before = sum_of(past.before, {0, 0, before.walls, before.sources});
    result.before.walls += surplus(result.state);
    result.steps = lengthening_steps(physics.clock.clock(time),
                                     physics.clock.clock(scene.end_time),
                                     steps_for(setting, crossing), growth_of_steps);
    result.event = {crossing, fmt::format("the wall {} passes the melting temperature "
                                          "and a front starts there",
                                          to_string(side_at(scene, inner)))};
    return result;
  }

  RunSegment remaining_stretch(const EventScene &setting, const RunSegment &past,
                               const double time, const Vector<double> &u,
                               const bool inner_vanishes)
  {
    const RayScene &rays = setting.rays;
    const FittedProblem &old = *past.problem;
    if(inner_vanishes && old.physics().power)
      throw cases::Refusal(fmt::format(
          "fem-fitted does not simulate a source whose own phase vanishes, which "
          "leaves no field to split off: at t = {:.6g}",
          time));
    const int kept = inner_vanishes ? 1 : 0;
    const unsigned int front = old.mesh().front_level();
    const unsigned int first = inner_vanishes ? front : 0;
    const unsigned int last = inner_vanishes ? old.mesh().n_levels() - 1 : front;

    // The same cells, which now reach the wall.
    const double from = old.coordinate(0, first, u), to = old.coordinate(0, last, u);
    std::vector<double> shares;
    for(unsigned int level = first; level <= last; level += rays.surface.degree)
      shares.push_back((old.coordinate(0, level, u) - from) / (to - from));
    Physics physics = one_phase_physics(setting, old.physics().phases[kept].solid);
    if(setting.options.clock != "t")
      physics.clock = {true, time};

    RunSegment result;
    result.problem = std::make_shared<FittedProblem>(
        RayMesh(rays.surface, rays.inner, rays.outer, shares), physics);
    result.time = time;
    result.state.reinit(result.problem->size());
    for(unsigned int level = first; level <= last; ++level)
      result.state[result.problem->mesh().node(0, level - first)]
          = old.theta(kept, 0, level, time, u);
    const HeatContent before = old.heat(time, u),
                      now = result.problem->heat(time, result.state);
    result.before = sum_of(past.before, before);
    result.before.sensible -= now.sensible;
    result.before.latent -= now.latent;
    const double end = physics.clock.clock(setting.scene.end_time);
    result.steps = {{end, (end - physics.clock.clock(time)) / steps_for(setting, time)}};
    result.event
        = {time, fmt::format("the front reaches {}",
                             inner_vanishes && old.mesh().has_centre()
                                 ? "the centre"
                                 : fmt::format(
                                     "the wall {}",
                                     to_string(side_at(setting.scene, inner_vanishes))))};
    return result;
  }
} // namespace meltfront::reference_fem::fitted
