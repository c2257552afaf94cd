#include <reference_fem/fitted/run.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    /** Elements along a line are graded beside walls and of degree four: of an inner wall
     * an eighth as wide as a spacing the solid in a pipe was 0.3 % off, of one a
     * twentieth as wide 7 %. */
    constexpr double widths_of_wall = 0.125;

    /** Of neighbouring nodes on the first ray (m). */
    double largest_node_distance(const FittedProblem &problem,
                                 const dealii::Vector<double> &state)
    {
      double largest = 0;
      for(unsigned int level = 1; level < problem.mesh().n_levels(); ++level)
        largest = std::max(largest, problem.coordinate(0, level, state)
                                        - problem.coordinate(0, level - 1, state));
      return largest;
    }
  } // namespace

  cases::RunDescription FittedRun::describe() const
  {
    const RayMesh &mesh = problem->mesh();
    cases::RunDescription result;
    result.dimension = options.dimension;
    result.spacing = scene.domain.side() / options.cells;
    if(options.dimension == 1)
    {
      result.resolved_width = widths_of_wall * result.spacing;
      result.node_distance = largest_node_distance(*problem, initial_state);
    }
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
           {"time scheme", options.scheme_name, ""},
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

  cases::Snapshot FittedRun::snapshot(long step, double time)
  {
    cases::Snapshot snapshot;
    snapshot.step = step;
    sites->read(time, *shown, snapshot);
    const HeatContent heat = problem->heat(time, *shown);
    snapshot.heat.stored = heat.sensible + before.sensible;
    snapshot.heat.latent = heat.latent + before.latent;
    snapshot.heat.boundary = heat.walls + before.walls;
    snapshot.heat.sources = heat.sources + before.sources;
    snapshot.heat.initial = initial_heat;
    return snapshot;
  }

  cases::Cost FittedRun::cost() const
  {
    cases::Cost cost;
    cost.steps = integration.steps;
    cost.unknowns = most_unknowns;
    cost.work = integration.work;
    cost.solver_iterations = integration.iterations;
    cost.most_iterations = integration.most_iterations;
    cost.effects = effect_costs;
    cost.evidence = evidence();
    return cost;
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

  std::map<std::string, double> FittedRun::evidence() const
  {
    std::map<std::string, double> result{
        {"events that changed the mesh", static_cast<double>(events)},
        {"steps divided in two", static_cast<double>(integration.halved)},
        {"factorisations", static_cast<double>(integration.factorisations)}};
    if(options.dimension == 1)
      result["highest mode of a cell at the end, of the temperature scale"]
          = highest_mode;
    if(options.tolerance > 0)
      result["steps repeated by the step control"]
          = static_cast<double>(integration.repeated);
    if(options.scheme_name.starts_with("bdf"))
    {
      result["steps that fell back to Radau"]
          = static_cast<double>(integration.fallbacks);
      result["steps of Radau that start BDF"] = static_cast<double>(integration.starts);
    }
    return result;
  }
} // namespace meltfront::reference_fem::fitted
