#include <reference_fem/fitted/events/layered_state.h>
#include <reference_fem/fitted/events/profile.h>

#include <cases/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using cases::BoundaryKind;

    /** Of the temperature scale: a wall is held elsewhere than what lies at it, or its
     * flux makes a difference of that much over the ray. */
    constexpr double least_jump = 1e-6;

    /** Distance of the points, of the room at a wall, by which the slope there is taken.
     */
    constexpr double difference = 1e-5;

    /** A distance from the wall at which the initial temperature counts as the wall's,
     * as a share of the ray. */
    constexpr double beside_wall = 1e-9;

    /** Fewest steps of a segment that begins during the run. */
    constexpr int fewest_steps = 20;
  } // namespace

  int steps_for(const EventScene &setting, const double from)
  {
    const cases::Scene &scene = setting.scene;
    if(from == scene.start_time)
      return setting.options.steps;
    const double share = (scene.end_time - from) / (scene.end_time - scene.start_time);
    return std::max(fewest_steps,
                    static_cast<int>(std::ceil(share * setting.options.steps)));
  }

  double time_to_breakpoint(const cases::Scene &scene, const double time)
  {
    double result = std::numeric_limits<double>::infinity();
    for(const cases::Side side : scene.sides())
      for(const double point : scene.boundary(side).value.breakpoints)
        if(point > time)
          result = std::min(result, point - time);
    return result;
  }

  LayeredState initial_layers(const EventScene &setting, const RunSegment &segment)
  {
    LayeredState result = layers_of(segment, segment.time, segment.state);
    const RayMesh geometry(setting.rays.surface, setting.rays.inner, setting.rays.outer,
                           {0, 1});
    result.temperature = [&scene = setting.scene, geometry](const double r)
    { return scene.initial.temperature(geometry.position(0, r), scene.start_time); };
    result.untouched = result.fronts.empty();
    return result;
  }

  LayeredState layers_of(const RunSegment &segment, const double time,
                         const dealii::Vector<double> &u)
  {
    const FittedProblem &problem = *segment.problem;
    const HeatContent heat = problem.heat(time, u);
    LayeredState result;
    result.time = time;
    for(unsigned int front = 0; front < problem.mesh().n_fronts(); ++front)
      result.fronts.push_back(u[problem.mesh().front_node(0, front)]);
    result.solid_inside = problem.phase(0).solid;
    result.shares = problem.mesh().shares;
    result.temperature = [profile = Profile(problem, time, u),
                          melting = problem.physics().melting_temperature](const double r)
    { return melting + profile.value(r); };
    result.heat = heat.sensible + heat.latent;
    result.before = segment.before;
    result.before.walls += heat.walls;
    result.before.sources += heat.sources;
    return result;
  }

  double room_at_wall(const EventScene &setting, const LayeredState &state,
                      const bool inner)
  {
    const RayScene &rays = setting.rays;
    if(state.fronts.empty())
      return rays.outer - rays.inner;
    return inner ? state.fronts.front() - rays.inner : rays.outer - state.fronts.back();
  }

  Physics physics_between(const EventScene &setting, const bool solid_inside,
                          const std::size_t fronts)
  {
    const bool moves = setting.effects.contains(cases::Effect::liquid_motion);
    if(moves && fronts > 1)
      throw cases::Refusal("fem-fitted follows one front where the densities of the "
                           "phases differ, not several");
    Physics physics = physics_of(setting.scene, setting.effects, setting.options,
                                 solid_inside || fronts == 0);
    if(fronts > 0)
      return physics;
    if(!solid_inside)
      std::swap(physics.phases[0], physics.phases[1]);
    // Liquid moves only where a front makes it.
    physics.displacement = 0;
    return physics;
  }

  std::vector<double> fronts_with(const EventScene &setting, const LayeredState &state,
                                  const std::vector<NewLayer> &layers)
  {
    std::vector<double> result = state.fronts;
    for(const NewLayer &layer : layers)
      if(layer.inner)
        result.insert(result.begin(), setting.rays.inner + layer.width);
      else
        result.push_back(setting.rays.outer - layer.width);
    return result;
  }

  std::array<cases::WallLayer, 2> layers_at_walls(const EventScene &setting,
                                                  const LayeredState &state)
  {
    const cases::Scene &scene = setting.scene;
    const RayScene &rays = setting.rays;
    const RayMesh geometry(rays.surface, rays.inner, rays.outer, {0, 1});
    const Physics physics = physics_between(setting, true, 0);
    std::array<cases::WallLayer, 2> result;
    for(const bool inner : {true, false})
    {
      if(inner && geometry.has_centre())
        continue;
      const cases::Boundary &wall = inner ? physics.inner_wall : physics.outer_wall;
      const cases::Position place = geometry.position(0, inner ? rays.inner : rays.outer);
      const double beside = temperature_at_end(setting, state, inner);
      if(wall.exact)
        continue;
      if(wall.kind == BoundaryKind::fixed_temperature)
      {
        const double jump = wall.value(place, state.time) - beside;
        if(std::abs(jump) > least_jump * physics.temperature_scale)
          result[inner ? 0 : 1].jump = jump;
        continue;
      }
      // By the parabola through three points beside the wall.
      const double room = room_at_wall(setting, state, inner), h = difference * room;
      const auto at = [&](const int k)
      { return state.temperature(inner ? rays.inner + k * h : rays.outer - k * h); };
      const double conducted = (-2.5 * at(1) + 4 * at(2) - 1.5 * at(3)) / h;
      const double given
          = wall.kind == BoundaryKind::insulated
                ? 0
                : cases::heat_through(wall, place, state.time, beside).flux;
      const cases::PhaseProperties &phase
          = state.solid_at(inner) ? scene.material.solid : scene.material.liquid;
      const double slope = given / phase.conductivity + conducted;
      if(std::abs(slope) * (rays.outer - rays.inner)
         > least_jump * physics.temperature_scale)
        result[inner ? 0 : 1].slope = slope;
    }
    return result;
  }

  std::shared_ptr<FittedProblem> problem_with(const EventScene &setting,
                                              const LayeredState &state,
                                              const std::vector<NewLayer> &layers,
                                              std::array<double, 2> thickness,
                                              const Clock &clock)
  {
    const RayScene &rays = setting.rays;
    std::vector<std::vector<double>> shares = state.shares;
    for(const NewLayer &layer : layers)
      thickness[layer.inner ? 0 : 1] = layer.layer;
    if(state.untouched)
      shares = {shares_of_layers(rays, thickness[0], thickness[1])};
    else
      for(const bool inner : {true, false})
        if(const double layer = thickness[inner ? 0 : 1]; layer > 0)
        {
          std::vector<double> &old = inner ? shares.front() : shares.back();
          old = drawn_shares(
              old, 4 * layer / (rays.cells * room_at_wall(setting, state, inner)),
              widening(rays), inner);
        }
    const std::vector<double> equal
        = graded_shares(std::max(1, rays.cells / 2), 1, false);
    bool solid_inside = state.solid_inside;
    for(const NewLayer &layer : layers)
    {
      shares.insert(layer.inner ? shares.begin() : shares.end(), equal);
      solid_inside = solid_inside != layer.inner;
    }
    Physics physics = physics_between(setting, solid_inside, shares.size() - 1);
    physics.clock = clock;
    return std::make_shared<FittedProblem>(
        RayMesh(rays.surface, rays.inner, rays.outer, shares), physics);
  }

  double temperature_at_end(const EventScene &setting, const LayeredState &state,
                            const bool inner)
  {
    const RayScene &rays = setting.rays;
    const double distance = beside_wall * (rays.outer - rays.inner);
    return state.temperature(inner ? rays.inner + distance : rays.outer - distance);
  }

  double coordinate_of(const EventScene &setting, const cases::Position &p)
  {
    return setting.scene.domain.round() ? std::hypot(p[0], p[1], p[2]) : p[0];
  }
} // namespace meltfront::reference_fem::fitted
