#include <cases/error.h>
#include <particles/scattered/linear_growth.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    /** Half waves along the domain's side that a steady state is made of, for the most
     * part; growth that power iteration is sure of. */
    constexpr double waves_of_steady_states = 5, least_growth = 1.001;

    void refuse_growth(double growth, double allowed, const std::string &method)
    {
      if(growth > allowed)
        throw cases::Refusal(fmt::format(
            "{}: the rows are not stable with these particles, errors grow by {:.3g} per "
            "step; another n, arrangement or dilation may be",
            method, growth));
    }
  } // namespace

  double growth_per_step(LinearSolver &solver, const CompressedRows &mass, double rate)
  {
    // The growth is that of the last steps, when the mode that grows fastest is left.
    constexpr int steps = 40, measured = 10;
    const std::size_t n = mass.rows();
    std::vector<double> state(n), load(n);
    for(std::size_t i = 0; i < n; ++i)
      state[i] = std::sin(1.7 * double(i) * double(i + 1));
    double growth = 0;
    for(int k = 0; k < steps; ++k)
    {
      double before = 0, after = 0;
      for(const double value : state)
        before += value * value;
      if(before == 0)
        return 0;
      mass.multiply(state, load, 1);
      for(double &value : load)
        value *= rate / std::sqrt(before);
      if(!solver.solve(load, state).converged)
        return std::numeric_limits<double>::quiet_NaN();
      for(const double value : state)
        after += value * value;
      if(k >= steps - measured)
        growth += std::log(after) / (2 * measured);
    }
    return std::exp(growth);
  }

  void require_steady_rows(const cases::Scene &scene, const LinearProblem &problem,
                           const LinearSolverParameters &parameters,
                           const std::string &method)
  {
    const double wave_number
        = waves_of_steady_states * std::numbers::pi / scene.domain.side();
    const double rate = scene.material.solid.diffusivity() * wave_number * wave_number;
    LinearSolver solver(sum_of(rate, problem.mass, -1, problem.operator_rows),
                        parameters);
    refuse_growth(growth_per_step(solver, problem.mass, rate), least_growth, method);
  }

  void require_stable_steps(const LinearProblem &problem, LinearSolver &solver,
                            double rate, long steps, const std::string &method)
  {
    refuse_growth(growth_per_step(solver, problem.mass, rate),
                  std::pow(2, 1 / double(steps)), method);
  }
} // namespace meltfront::particles
