#include <reference_fem/fitted/run.h>

#include <fmt/format.h>

namespace meltfront::reference_fem::fitted
{
  cases::RunDescription FittedRun::description() const
  {
    const RayMesh &mesh = problem->mesh();
    cases::RunDescription result;
    result.dimension = options.dimension;
    result.spacing = scene.domain.side() / options.cells;
    result.time_step = (scene.end_time - scene.start_time) / options.steps;
    result.unknowns = problem->size();
    result.parameters
        = {{"elements",
            fmt::format("degree {} along rays that carry the front, in conservative form",
                        options.degree),
            ""},
           {"mesh",
            fmt::format("{} rays, {} x {} cells along and across the front, {}D",
                        mesh.surface.n_rays(), mesh.surface.cells.size(),
                        mesh.layers.size(), options.dimension),
            ""},
           {"time scheme", resolution.options.get_string("scheme"), ""},
           {"clock", problem->physics().clock.root ? "sqrt(t)" : "t", ""},
           {"steps",
            options.tolerance > 0
                ? fmt::format("chosen for an error of {:g}", options.tolerance)
                : fmt::format("{}, equal on the clock", options.steps),
            ""},
           {"mean time step", fmt::format("{:.6g}", result.time_step), "s"},
           {"nonlinear solver", "Newton's method for all unknowns, the front among them",
            ""},
           {"linear solver", "UMFPACK", ""}};
    return result;
  }

  void FittedRun::observe(cases::Observer &observer, long step, double time,
                          const dealii::Vector<double> &u)
  {
    cases::Snapshot snapshot;
    snapshot.step = step;
    sites->read(time, u, snapshot);
    const HeatContent heat = problem->heat(time, u);
    snapshot.heat.stored = heat.sensible + before.sensible;
    snapshot.heat.latent = heat.latent + before.latent;
    snapshot.heat.boundary = heat.walls + before.walls;
    snapshot.heat.sources = heat.sources + before.sources;
    snapshot.heat.initial = initial_heat;
    observer.observe(snapshot);
  }

  void FittedRun::report(cases::Observer &observer, long step, double time,
                         const dealii::Vector<double> &u, bool always)
  {
    watch.without(
        [&]
        {
          if(observer.wants(step, time) || always)
            observe(observer, step, time, u);
        });
  }

  std::vector<cases::EffectCost>
  FittedRun::effect_costs(const IntegrationCost &cost) const
  {
    // All effects are terms of the same integrals, entered once an iteration: none has
    // memory or time of its own to tell.
    std::vector<cases::EffectCost> result;
    for(const cases::EffectDecision &decision : effects.decisions())
      if(decision.on)
        result.push_back({decision.effect, cost.iterations, 0, 0});
    return result;
  }
} // namespace meltfront::reference_fem::fitted
