#include <reference_fem/fitted/time/stage_newton.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    /** Iterations of a step beyond which factors are renewed. */
    constexpr unsigned int aimed_iterations = 5;

    /** Factors that needed no more are kept for the next step, as they may need two more
     * there before it shows that they must be renewed. */
    constexpr unsigned int easy_iterations = 3;

    /** Corrections below this size need no fresh exact Jacobian: the old one contracts
     * by about as much. */
    constexpr double small_correction = 1e-5;

    /** The next correction is not trusted to be smaller by more than this. */
    constexpr double best_contraction = 0.1;

    /** Corrections that no longer shrink and are below this multiple of the tolerance
     * are rounding. */
    constexpr double rounding_factor = 1e3;

    double largest(const Stages &correction, const dealii::Vector<double> &scale)
    {
      double result = 0;
      for(const auto &stage : correction)
        for(unsigned int i = 0; i < scale.size(); ++i)
        {
          const double size = std::abs(stage[i]) / scale[i];
          if(!std::isfinite(size))
            return size;
          result = std::max(result, size);
        }
      return result;
    }

    double product(const Stages &a, const Stages &b, const dealii::Vector<double> &scale)
    {
      double sum = 0;
      for(std::size_t j = 0; j < a.size(); ++j)
        for(unsigned int i = 0; i < scale.size(); ++i)
          sum += a[j][i] * b[j][i] / (scale[i] * scale[i]);
      return sum;
    }

    void add(const double factor, const Stages &correction, Stages &u)
    {
      for(std::size_t j = 0; j < u.size(); ++j)
        u[j].add(factor, correction[j]);
    }
  } // namespace

  StageNewton::StageNewton(const ConservationProblem &problem,
                           const IntegrationOptions &options, IntegrationCost &cost)
    : problem(problem)
    , options(options)
    , cost(cost)
    , exact(problem.size() <= options.largest_exact_size)
    , solver(exact ? make_exact_stage_solver(problem, cost)
                   : make_frozen_stage_solver(problem, cost))
  {
  }

  StageNewton::Result StageNewton::solve(StageEquations &equations,
                                         const dealii::Vector<double> &scale, Stages &u)
  {
    Result result;
    past_corrections.clear();
    Stages residual, correction = u;
    double previous = 0, contraction = 1;
    if(!prepare_for(equations, u))
      return {0, "meets a singular Jacobian"};
    equations.evaluate(u, residual);
    while(result.iterations < options.iteration_limit)
    {
      solver->correct(residual, correction);
      if(!exact)
        learn(scale, correction);
      const double size = largest(correction, scale);
      ++result.iterations;
      ++cost.iterations;
      if(!std::isfinite(size))
        return {result.iterations, "meets a correction that is not finite"};
      result.problem = apply(correction, u);
      if(!result.problem.empty())
        return result;
      if(result.iterations > 1)
        contraction = size / previous;
      const bool rounding = contraction > 0.5
                            && size <= rounding_factor * options.solver_tolerance
                            && result.iterations > 1;
      if(size * std::clamp(contraction, best_contraction, 1.) <= options.solver_tolerance
         || rounding)
      {
        factors_serve = result.iterations <= easy_iterations;
        return result;
      }
      if(!renew(equations, u, result.iterations, size, contraction))
        return {result.iterations, "meets a singular Jacobian"};
      equations.evaluate(u, residual);
      previous = size;
    }
    factors_serve = false;
    result.problem = "does not converge in " + std::to_string(result.iterations)
                     + " iterations of Newton's method; a shorter step would help";
    return result;
  }

  bool StageNewton::prepare_for(const StageEquations &equations, const Stages &u)
  {
    // The exact Jacobian belongs to a state, a frozen one to a step and a scheme.
    current = exact || !factors_serve || equations.n_stages() != factorised_stages
              || std::abs(equations.step() / factorised_step - 1) > 1e-6;
    if(!current)
      return true;
    factorised_step = equations.step();
    factorised_stages = equations.n_stages();
    factors_serve = false;
    return solver->prepare(equations, u);
  }

  bool StageNewton::renew(const StageEquations &equations, const Stages &u,
                          const unsigned int iteration, const double size,
                          const double contraction)
  {
    if(exact)
      return size <= small_correction || solver->prepare(equations, u);
    if(iteration < 2 || size <= rounding_factor * options.solver_tolerance)
      return true;
    const unsigned int left = std::max(aimed_iterations, iteration) - iteration;
    const bool slow = size * std::pow(contraction, left) > options.solver_tolerance;
    if(current ? contraction < 0.5 : !slow)
      return true;
    current = true;
    past_corrections.clear();
    return solver->prepare(equations, u);
  }

  void StageNewton::learn(const dealii::Vector<double> &scale, Stages &correction)
  {
    const std::size_t n_past = past_corrections.size();
    if(n_past > 0)
    {
      for(std::size_t k = 0; k + 1 < n_past; ++k)
      {
        const Stages &past = past_corrections[k];
        add(product(past, correction, scale) / product(past, past, scale),
            past_corrections[k + 1], correction);
      }
      const Stages &last = past_corrections.back();
      const double share = product(last, correction, scale) / product(last, last, scale);
      if(share < 0.9)
        for(auto &stage : correction)
          stage /= 1 - share;
    }
    past_corrections.push_back(correction);
  }

  std::string StageNewton::apply(const Stages &correction, Stages &u)
  {
    const auto reason_invalid = [&](const Stages &states)
    {
      std::string first;
      for(const auto &stage : states)
        if(first.empty())
          first = problem.reason_invalid(stage);
      return first;
    };
    std::string full;
    for(double share = 1; share > 0.1; share /= 2)
    {
      Stages trial = u;
      add(share, correction, trial);
      const std::string complaint = reason_invalid(trial);
      if(complaint.empty())
      {
        u = std::move(trial);
        if(share < 1)
          past_corrections.clear();
        return {};
      }
      if(full.empty())
        full = complaint;
    }
    return "leaves the states that have a meaning: " + full;
  }
} // namespace meltfront::reference_fem::fitted
