#include <reference_fem/fitted/events/resolution.h>
#include <reference_fem/fitted/run.h>

#include <cases/error.h>

#include <deal.II/base/multithread_info.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  FittedRun::FittedRun(const cases::Scene &scene, const cases::EffectSet &effects,
                       const cases::Resolution &resolution)
    : scene(scene)
    , effects(effects)
    , resolution(resolution)
    , options(options_for(scene, resolution))
    , bounds(cases::temperature_bounds(scene))
  {
    for(const cases::EffectDecision &decision : effects.decisions())
      if(decision.on)
        effect_costs.push_back({.effect = decision.effect});
    // With threads, deal.II rounds sums over vectors differently.
    dealii::MultithreadInfo::set_thread_limit(1);
    const RayScene rays = rays_of(scene, options);
    const InitialFronts fronts = initial_fronts(scene, rays);
    if(fronts.number == 0)
    {
      if(options.dimension > 1)
        throw cases::Refusal("fem-fitted needs a front to start from in more than one "
                             "dimension; this scene starts in one phase");
      if(effects.contains(cases::Effect::volumetric_source))
        throw cases::Refusal("fem-fitted needs a front to start from where heat is "
                             "released throughout; this scene starts in one phase");
      const RunSegment segment = one_phase_stretch({scene, effects, options, rays});
      problem = segment.problem;
      initial_state = segment.state;
    }
    else
    {
      RayMesh mesh = mesh_between_fronts(rays, fronts.number, options.grading);
      const Physics physics = physics_between({scene, effects, options, rays},
                                              fronts.solid_inside, fronts.number);
      const auto temperature = [&](const cases::Position &p)
      { return scene.initial.temperature(p, scene.start_time); };
      mesh = resolving_mesh(mesh, physics, scene.start_time, fronts.coordinates,
                            temperature);
      problem = std::make_shared<FittedProblem>(mesh, physics);
      initial_state = problem->state(scene.start_time, fronts.coordinates, temperature);
      straighten_jumps(*problem, scene.start_time, initial_state);
    }
    const std::string reason_invalid = problem->reason_invalid(initial_state);
    if(!reason_invalid.empty())
      throw cases::NumericalError(method_name, 0, scene.start_time, "the initial state",
                                  "is impossible: " + reason_invalid);
    const HeatContent heat = problem->heat(scene.start_time, initial_state);
    initial_heat = heat.sensible + heat.latent;
    sites = std::make_unique<Sites>(*problem);
  }

  IntegrationOptions FittedRun::integration_options() const
  {
    IntegrationOptions result;
    // Matrices of one ray are narrow bands and cheap to factorise anew.
    if(options.dimension == 1)
      result.largest_exact_size = std::numeric_limits<unsigned int>::max();
    result.scheme = options.scheme;
    result.tolerance = options.tolerance;
    // Fluxes of the better conductor are rounded by so much of those of the other, and
    // Newton's method takes up to a thousand times its tolerance for rounding.
    const auto [poorer, better] = std::minmax(scene.material.solid.conductivity,
                                              scene.material.liquid.conductivity);
    result.solver_tolerance
        = std::max(result.solver_tolerance, 1e-3 * 0x1p-53 * better / poorer);
    result.method = method_name;
    result.time
        = [clock = problem->physics().clock](double value) { return clock.time(value); };
    return result;
  }

  double FittedRun::clock_step() const
  {
    const Clock &clock = problem->physics().clock;
    return (clock.clock(scene.end_time) - clock.clock(scene.start_time)) / options.steps;
  }

  /** Within the bounds of the scene, of which the walls' values at the nodes are part. */
  void FittedRun::check_temperatures(long step, double time,
                                     const dealii::Vector<double> &u)
  {
    const RayMesh &mesh = problem->mesh();
    const Physics &physics = problem->physics();
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for(unsigned int ray = 0; ray < mesh.surface.n_rays(); ++ray)
      for(unsigned int level = 0; level < mesh.n_levels(); ++level)
      {
        const double r = problem->coordinate(ray, level, u);
        if(mesh.front_at(level) != RayMesh::none || (r == 0 && physics.power))
          continue;
        const double value = physics.melting_temperature + u[mesh.node(ray, level)]
                             + problem->source(mesh.interval_of(level), time).value(r);
        const cases::Boundary *wall = level == 0                     ? &physics.inner_wall
                                      : level + 1 == mesh.n_levels() ? &physics.outer_wall
                                                                     : nullptr;
        if(step == 0 || (wall && wall->kind == cases::BoundaryKind::fixed_temperature))
        {
          bounds.lower = std::min(bounds.lower, value);
          bounds.upper = std::max(bounds.upper, value);
        }
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
    // What Newton's method leaves of a state at rest, be it at 0.
    constexpr double solved_to = 1e-10;
    const double left = solved_to * physics.temperature_scale;
    try
    {
      cases::check_temperature(
          bounds, lowest + left, highest - left, method_name, step, time,
          cases::allowed_overshoot(overshoot, scene.domain.side() / options.cells,
                                   scene.domain));
    }
    catch(const cases::NumericalError &)
    {
      refuse_unresolved_layer(time, u);
      throw;
    }
    front_before = time;
    fronts = front_coordinates(u);
  }

  std::vector<double> FittedRun::front_coordinates(const dealii::Vector<double> &u) const
  {
    const RayMesh &mesh = problem->mesh();
    std::vector<double> result;
    for(unsigned int front = 0; front < mesh.n_fronts(); ++front)
      for(unsigned int ray = 0; ray < mesh.surface.n_rays(); ++ray)
        result.push_back(u[mesh.front_node(ray, front)]);
    return result;
  }

  /** Temperatures pass their bounds where elements are longer than the layer of heat
   * beside the front, the diffusivity over its speed: their Peclet number exceeds one. */
  void FittedRun::refuse_unresolved_layer(double time,
                                          const dealii::Vector<double> &u) const
  {
    const std::vector<double> now = front_coordinates(u);
    if(now.empty() || !(time > front_before))
      return;
    // From where the fronts were, or from the nearest place that one may have left.
    std::vector<double> places = fronts;
    places.push_back(problem->mesh().inner);
    places.push_back(problem->mesh().outer);
    double way = 0;
    for(std::size_t k = 0; k < now.size(); ++k)
    {
      const auto from = [&](double r) { return std::abs(now[k] - r); };
      way = std::max(way, fronts.size() == now.size()
                              ? from(fronts[k])
                              : std::ranges::min(places | std::views::transform(from)));
    }
    const double speed = way / (time - front_before);
    const auto &phases = problem->physics().phases;
    const double diffusivity = std::min(phases[0].conductivity / phases[0].capacity,
                                        phases[1].conductivity / phases[1].capacity);
    const double layer = diffusivity / speed;
    const double cell = scene.domain.side() / options.cells;
    if(layer < cell)
      throw cases::Refusal(fmt::format(
          "{}: at t = {:.6g} the layer of heat beside the front, its diffusivity over "
          "the front's speed, is {:.3g} m thick, and temperatures pass their bounds "
          "where "
          "cells of {:.3g} m are longer than that: take n >= {:.3g}",
          method_name, time, layer, cell, std::ceil(scene.domain.side() / layer)));
  }

  void FittedRun::enter(const RunSegment &segment)
  {
    if(problem != segment.problem)
      add_effect_costs();
    if(!segment.event.text.empty())
    {
      ++events;
      note(segment.event.time, segment.event.text);
    }
    problem = segment.problem;
    before = segment.before;
    sites = std::make_unique<Sites>(*problem);
    most_unknowns = std::max<long>(most_unknowns, problem->size());
  }

  void FittedRun::take_steps()
  {
    check_temperatures(0, scene.start_time, initial_state);
    most_unknowns = problem->size();
    const Clock &clock = problem->physics().clock;
    RunSegment first{problem,
                     initial_state,
                     scene.start_time,
                     {},
                     {{clock.clock(scene.end_time), clock_step()}},
                     {}};
    Timeline timeline(
        {scene, effects, options, rays_of(scene, options)}, integration_options(),
        {[&](const RunSegment &segment) { enter(segment); },
         [&](long step, double time, const dealii::Vector<double> &u, bool last)
         {
           check_temperatures(step, time, u);
           if(last && options.dimension == 1)
             highest_mode = std::ranges::max(highest_modes(*problem, time, u));
           shown = &u;
           reached(step, time);
         },
         [this](double time, const dealii::Vector<double> &u)
         { refuse_unresolved_layer(time, u); }});
    timeline.run(std::move(first));
    integration = timeline.cost();
    add_effect_costs();
  }
} // namespace meltfront::reference_fem::fitted
