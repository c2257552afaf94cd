#include <particles/scattered/linear_choices.h>
#include <particles/scattered/linear_run.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace meltfront::particles
{
  cases::Snapshot LinearRun::snapshot(long k, double time)
  {
    cases::Snapshot snapshot;
    snapshot.step = k;
    snapshot.time = time;
    snapshot.dimension = sites.dimension;
    snapshot.positions = sites.positions;
    snapshot.weights = sites.weights;
    snapshot.temperature = temperatures();
    snapshot.solid_fraction = solid_fraction;
    snapshot.obeys_maximum_principle = obeys_maximum_principle();
    snapshot.heat.conservative = static_cast<bool>(problem.inflow);
    if(snapshot.heat.conservative && steady())
    {
      // Without release the walls' sum is round-off, with nothing to relate it to.
      const HeatInflow inflow = problem.inflow(steady_step(time), unknowns);
      snapshot.heat.conservative = inflow.released != 0;
      snapshot.heat.boundary = inflow.through_walls;
      snapshot.heat.sources = inflow.released;
    }
    else if(snapshot.heat.conservative)
    {
      snapshot.heat = heat;
      snapshot.heat.stored = stored_heat();
      snapshot.heat.initial = initial_heat;
    }
    // Who keeps no book has no answer to what was taken in: not zero.
    if(!snapshot.heat.conservative)
      snapshot.heat.stored = std::numeric_limits<double>::quiet_NaN();
    return snapshot;
  }

  cases::RunDescription LinearRun::describe() const
  {
    cases::RunDescription result = description.run;
    result.time_step = length;
    result.unknowns = static_cast<long>(n);
    result.parameters.push_back(
        {"linear solver", linear_method_names()[std::size_t(solver->method())], ""});
    result.parameters.push_back(
        {"entries per row",
         fmt::format("{:.4g}", double(problem.operator_rows.size()) / double(n)), "1"});
    result.parameters.push_back({"entries of factors or preconditioner over those "
                                 "of the matrix",
                                 fmt::format("{:.3g}", solver->fill()), "1"});
    if(std::isfinite(solver->reciprocal_condition()))
      result.parameters.push_back({"reciprocal condition of the matrix (UMFPACK)",
                                   fmt::format("{:.2g}", solver->reciprocal_condition()),
                                   "1"});
    if(length > 0)
      result.parameters.push_back(
          {"time scheme", linear_scheme_names()[std::size_t(options.time_scheme)], ""});
    else
    {
      result.parameters.push_back(
          {"iterations of the linear solver", std::to_string(iterations), "1"});
      result.parameters.push_back(
          {"residual", fmt::format("{:.1e}", worst_residual), "1"});
    }
    return result;
  }

  cases::Cost LinearRun::cost() const
  {
    cases::Cost result;
    result.steps = steps;
    result.unknowns = static_cast<long>(n);
    result.work = description.setup_work + work;
    result.solver_iterations = iterations;
    result.most_iterations = most_iterations;
    result.effects = posed->effect_costs(effects);
    return result;
  }
} // namespace meltfront::particles
