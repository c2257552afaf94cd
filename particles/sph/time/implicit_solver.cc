#include <particles/sph/time/implicit_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles
{
  namespace
  {
    constexpr int most_newton_iterations = 60;
    constexpr int most_linear_iterations = 500;

    /** Of a linear solve: residual over right-hand side. */
    constexpr double linear_tolerance = 1e-4;

    /** Of the residual over the largest sensible heat of a particle. */
    constexpr double relative_tolerance = 1e-10;
  } // namespace

  ImplicitSolver::ImplicitSolver(ImplicitFlow &heat_flow)
    : heat_flow(heat_flow)
  {
    if(const std::size_t half = heat_flow.half_bandwidth(); half > 0)
      banded.emplace(heat_flow.padded_size(), half);
    else
      krylov.emplace(heat_flow.padded_size(),
                     [this](std::span<const double> change, std::span<double> result)
                     { multiply(change, result); });
    for(auto *array : {&flow, &residual, &correction, &diagonal})
      array->resize(heat_flow.padded_size(), 0.);
  }

  void ImplicitSolver::multiply(std::span<const double> change, std::span<double> result)
  {
    heat_flow.apply_derivative(change, result);
    for(std::size_t a = 0; a < change.size(); ++a)
      result[a] = change[a] - factor * result[a];
  }

  int ImplicitSolver::find_correction()
  {
    if(krylov)
      return krylov
          ->solve(diagonal, residual, correction, linear_tolerance,
                  most_linear_iterations)
          .iterations;
    if(!banded->factorise([this](std::span<const double> change, std::span<double> result)
                          { multiply(change, result); }))
      return 0;
    correction = residual;
    banded->solve(correction);
    return 1;
  }

  double ImplicitSolver::evaluate(const ImplicitEquation &equation,
                                  std::span<double> enthalpy)
  {
    wall_flow = heat_flow.evaluate(enthalpy, equation.fraction, flow);
    double largest = 0, zero = 0;
    for(std::size_t a = 0; a < equation.base.size(); ++a)
    {
      residual[a] = equation.base[a] + equation.factor * flow[a] - enthalpy[a];
      largest = std::max(largest, std::abs(residual[a]));
      zero += 0 * residual[a]; // not a number if the residual is not finite
    }
    return largest + zero;
  }

  double ImplicitSolver::tolerance(const ImplicitEquation &equation,
                                   std::span<const double> enthalpy) const
  {
    double stiffest = 0;
    for(std::size_t a = 0; a < equation.base.size(); ++a)
      stiffest = std::max(stiffest, diagonal[a]);
    const double rounding = 64 * std::numeric_limits<double>::epsilon();
    return (relative_tolerance + rounding * stiffest)
           * heat_flow.largest_sensible_heat(enthalpy);
  }

  double ImplicitSolver::add_flow(double change, std::span<const double> enthalpy)
  {
    const double walls = heat_flow.evaluate(enthalpy, 0, flow);
    for(std::size_t a = 0; a < heat_flow.size(); ++a)
      base[a] += change * flow[a];
    return walls;
  }

  ImplicitSolver::Outcome ImplicitSolver::solve(const ImplicitEquation &equation,
                                                std::span<double> enthalpy)
  {
    factor = equation.factor;
    Outcome outcome{false, 0, 0};
    for(;;)
    {
      const double size = evaluate(equation, enthalpy);
      // The last diagonal tells how stiff the equations are, too.
      outcome.converged = outcome.iterations > 0 && size <= tolerance(equation, enthalpy);
      if(!outcome.converged)
      {
        heat_flow.linearise(enthalpy, equation.fraction);
        const auto slopes = heat_flow.derivative_diagonal();
        for(std::size_t a = 0; a < diagonal.size(); ++a)
          diagonal[a] = 1 - factor * slopes[a];
        outcome.converged = size <= tolerance(equation, enthalpy);
      }
      if(outcome.converged || outcome.iterations == most_newton_iterations
         || !std::isfinite(size))
        break;
      ++outcome.iterations;
      const int iterations = find_correction();
      if(iterations == 0)
        break;
      krylov_iterations += iterations;
      heat_flow.correct(correction, enthalpy);
    }
    for(std::size_t a = 0; a < equation.base.size(); ++a)
      enthalpy[a] = equation.base[a] + equation.factor * flow[a];
    outcome.through_walls = wall_flow;
    longest = std::max<long>(longest, outcome.iterations);
    all_iterations += outcome.iterations;
    return outcome;
  }
} // namespace meltfront::particles
