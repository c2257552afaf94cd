#include <cases/demand.h>
#include <particles/scattered/linear_choices.h>
#include <particles/scattered/linear_problem.h>

#include <cmath>

namespace meltfront::particles
{
  const std::vector<std::string> &linear_scheme_names()
  {
    static const std::vector<std::string> names{"backward-euler", "crank-nicolson",
                                                "bdf2"};
    return names;
  }

  long linear_steps(const LinearOptions &options, int n)
  {
    return options.steps > 0 ? options.steps : std::max(50L, 4L * n);
  }

  long most_monotone_steps(const cases::Scene &scene, const LinearProblem &problem,
                           const LinearSites &sites)
  {
    const CompressedRows &mass = problem.mass;
    double largest = 0;
    for(std::size_t i = 0; i < mass.rows(); ++i)
    {
      double sum = 0, second = 0;
      for(std::size_t k = mass.offsets[i]; k < mass.offsets[i + 1]; ++k)
      {
        const std::size_t j = mass.columns[k];
        double square = 0;
        for(int d = 0; d < sites.dimension; ++d)
          square += std::pow(sites.positions[d][j] - sites.positions[d][i], 2);
        sum += mass.coefficients[k];
        second += mass.coefficients[k] * square;
      }
      if(sum > 0)
        largest = std::max(largest, second / sum);
    }
    const double paths = (scene.end_time - scene.start_time) * 2 * sites.dimension
                         * scene.material.solid.diffusivity() / largest;
    constexpr double any_number = 1e9;
    return std::lround(std::floor(std::min(paths, any_number)));
  }

  void LinearOptions::bind(cases::OptionBinder &options)
  {
    options.add("linear_solver", linear_solver,
                "Solver of the linear systems: direct factors for small ones, incomplete "
                "factors or multigrid with a Krylov method for large ones.",
                cases::in_order<LinearMethod>(linear_method_names()));
    options.add("solver_tolerance", solver_tolerance,
                "Residual over the right-hand side at which an iterative solver stops.",
                1e-16, 1);
    options.add("time_scheme", time_scheme, "Time steps of transient scenes.",
                cases::in_order<LinearScheme>(linear_scheme_names()));
    options.add("steps", steps,
                "Time steps of transient scenes; 0: four times n, but at least 50; "
                "fewer, but at least 10, where heat would move less far in a step than "
                "the rows of the mass matrix reach.",
                0, 1e9);
  }

  cases::Demand linear_demand(const cases::Scene &scene,
                              const cases::Resolution &resolution, const LinearSize &size)
  {
    // An entry has a coefficient and a column.
    constexpr double per_entry = 16;
    LinearSolverParameters solver;
    const auto options = cases::read_options(LinearOptions(), resolution.options);
    solver.method = options.linear_solver;
    solver.dimension = scene.domain.dimension;
    double fill = 2;
    switch(chosen_method(static_cast<std::size_t>(size.nodes), solver))
    {
    case LinearMethod::direct:
      fill = cases::fill_of_factors(solver.dimension, size.nodes);
      break;
    case LinearMethod::gmres_ilut:
      fill = solver.ilut_fill;
      break;
    default:
      break;
    }
    return {
        cases::program_bytes
            + size.nodes
                  * (size.per_node + size.entries * per_entry * (size.matrices + fill)),
        scene.problem == cases::ProblemKind::poisson
            ? 1.
            : double(linear_steps(options, resolution.n))};
  }
} // namespace meltfront::particles
