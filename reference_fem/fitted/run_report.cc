#include <reference_fem/fitted/run.h>

#include <fmt/format.h>

#include <algorithm>

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

  void FittedRun::add_effect_costs()
  {
    for(cases::EffectCost &sum : effect_costs)
    {
      const cases::EffectCost cost = problem->effect_cost(sum.effect);
      sum.calls += cost.calls;
      sum.bytes = std::max(sum.bytes, cost.bytes);
      sum.seconds += cost.seconds;
    }
  }

  std::map<std::string, double> FittedRun::evidence(const IntegrationCost &cost) const
  {
    std::map<std::string, double> result{
        {"events that changed the mesh", static_cast<double>(events)},
        {"steps divided in two", static_cast<double>(cost.halved)},
        {"factorizations", static_cast<double>(cost.factorizations)}};
    if(options.tolerance > 0)
      result["steps repeated by the step control"] = static_cast<double>(cost.repeated);
    if(resolution.options.get_string("scheme").starts_with("bdf"))
    {
      result["steps that fell back to Radau"] = static_cast<double>(cost.fallbacks);
      result["steps of Radau that start BDF"] = static_cast<double>(cost.starts);
    }
    return result;
  }
} // namespace meltfront::reference_fem::fitted
