#include <cases/error.h>
#include <particles/scattered/direct_solver.h>
#include <particles/scattered/iterative_solver.h>
#include <particles/scattered/linear_solver.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace meltfront::particles
{
  namespace
  {
    /** Unknowns up to which factors are cheaper than iterations, by dimension. */
    constexpr std::size_t direct_up_to[] = {0, 10'000'000, 20'000, 4'000};

    /** Unknowns beyond which the preconditioner must not weaken with their number. */
    constexpr std::size_t multigrid_from = 100'000;

    /** Where iterations fail: incomplete factors with so many times the entries, down to
     * so much smaller ones; then whole ones of so many times the unknowns for which they
     * are cheaper. */
    constexpr double stronger_fill = 4, stronger_drop = 1e-2;
    constexpr std::size_t direct_at_need = 5;

    /** One over the largest entry of each row; of a row of zeros, which makes the matrix
     * singular, one. */
    std::vector<double> row_scales(const CompressedRows &matrix)
    {
      std::vector<double> scales(matrix.rows(), 1.);
      for(std::size_t i = 0; i < matrix.rows(); ++i)
      {
        double largest = 0;
        for(std::size_t e = matrix.offsets[i]; e < matrix.offsets[i + 1]; ++e)
          largest = std::max(largest, std::abs(matrix.coefficients[e]));
        if(largest > 0)
          scales[i] = 1 / largest;
      }
      return scales;
    }

    double norm(std::span<const double> vector)
    {
      double sum = 0;
      for(const double value : vector)
        sum += value * value;
      return std::sqrt(sum);
    }
  } // namespace

  const std::vector<std::string> &linear_method_names()
  {
    static const std::vector<std::string> names{"automatic",    "direct",
                                                "gmres-ilut",   "cg-jacobi",
                                                "cg-multigrid", "gmres-multigrid"};
    return names;
  }

  LinearMethod chosen_method(std::size_t unknowns,
                             const LinearSolverParameters &parameters)
  {
    if(parameters.method != LinearMethod::automatic)
      return parameters.method;
    if(unknowns <= direct_up_to[std::clamp(parameters.dimension, 1, 3)])
      return LinearMethod::direct;
    if(unknowns > multigrid_from)
      return parameters.symmetric ? LinearMethod::cg_multigrid
                                  : LinearMethod::gmres_multigrid;
    return parameters.symmetric ? LinearMethod::cg_jacobi : LinearMethod::gmres_ilut;
  }

  struct LinearSolver::Implementation
  {
    using Outcome = LinearSolver::Outcome;

    Implementation(const CompressedRows &given, const LinearSolverParameters &parameters)
      : method(chosen_method(given.rows(), parameters))
      , tolerance(parameters.tolerance)
      , matrix(given)
    {
      const bool needs_symmetry
          = method == LinearMethod::cg_jacobi || method == LinearMethod::cg_multigrid;
      if(needs_symmetry && !parameters.symmetric)
        throw cases::InputError(
            fmt::format("conjugate gradients ({}) need a symmetric matrix, which this "
                        "one is not; take gmres-ilut",
                        linear_method_names()[static_cast<std::size_t>(method)]));
      if(!parameters.symmetric)
      {
        scales = row_scales(matrix);
        for(std::size_t i = 0; i < matrix.rows(); ++i)
          for(std::size_t e = matrix.offsets[i]; e < matrix.offsets[i + 1]; ++e)
            matrix.coefficients[e] *= scales[i];
      }
      if(method == LinearMethod::direct)
        direct.emplace(matrix);
      else
        iterative.emplace(matrix, method, parameters);
      if(parameters.method == LinearMethod::automatic && method != LinearMethod::direct)
        stronger = stronger_than(parameters);
      load.resize(matrix.rows());
      product.resize(matrix.rows());
    }

    Outcome solve_once(std::span<double> x)
    {
      Outcome outcome;
      if(direct)
        outcome.converged = direct->solve(load, x);
      else
        outcome = iterative->solve(load, x);
      matrix.multiply(x, product, 1);
      for(std::size_t i = 0; i < load.size(); ++i)
        product[i] -= load[i];
      outcome.residual = norm(product) / norm(load);
      // What Krylov methods carry along may part from the residual itself.
      constexpr double slack = 100;
      if(!std::isfinite(outcome.residual)
         || (iterative && outcome.residual > slack * tolerance))
        outcome.converged = false;
      return outcome;
    }

    /** Take the next of the stronger solvers. */
    void strengthen()
    {
      const LinearSolverParameters parameters = stronger.front();
      stronger.erase(stronger.begin());
      method = parameters.method;
      iterative.reset();
      if(method == LinearMethod::direct)
        direct.emplace(matrix);
      else
        iterative.emplace(matrix, method, parameters);
    }

    std::vector<LinearSolverParameters>
    stronger_than(const LinearSolverParameters &parameters) const
    {
      std::vector<LinearSolverParameters> result(2, parameters);
      result[0].method = LinearMethod::gmres_ilut;
      result[0].ilut_fill *= stronger_fill;
      result[0].drop_tolerance *= stronger_drop;
      result[1].method = LinearMethod::direct;
      if(matrix.rows()
         > direct_at_need * direct_up_to[std::clamp(parameters.dimension, 1, 3)])
        result.pop_back();
      return result;
    }

    LinearMethod method;
    double tolerance;
    std::vector<LinearSolverParameters> stronger; ///< to be tried where one fails
    CompressedRows matrix;
    std::vector<double> scales; ///< of rows; empty: none
    std::optional<DirectSolver> direct;
    std::optional<IterativeSolver> iterative;
    std::vector<double> load, product;
  };

  LinearSolver::LinearSolver(const CompressedRows &matrix,
                             const LinearSolverParameters &parameters)
    : implementation(std::make_unique<Implementation>(matrix, parameters))
  {
  }

  LinearSolver::~LinearSolver() = default;
  LinearSolver::LinearSolver(LinearSolver &&) noexcept = default;
  LinearSolver &LinearSolver::operator=(LinearSolver &&) noexcept = default;

  LinearSolver::Outcome LinearSolver::solve(std::span<const double> right_hand_side,
                                            std::span<double> x)
  {
    Implementation &impl = *implementation;
    for(std::size_t i = 0; i < impl.load.size(); ++i)
      impl.load[i] = right_hand_side[i] * (impl.scales.empty() ? 1. : impl.scales[i]);
    const double size = norm(impl.load);
    if(size == 0 && !(impl.direct && impl.direct->reciprocal_condition() == 0))
    {
      std::ranges::fill(x, 0.);
      return {true, 0, 0.};
    }
    const std::vector<double> guess(x.begin(), x.end());
    Outcome outcome = impl.solve_once(x);
    while(!outcome.converged && !impl.stronger.empty())
    {
      impl.strengthen();
      std::ranges::copy(guess, x.begin());
      const int before = outcome.iterations;
      outcome = impl.solve_once(x);
      outcome.iterations += before;
    }
    return outcome;
  }

  LinearMethod LinearSolver::method() const
  {
    return implementation->method;
  }

  double LinearSolver::reciprocal_condition() const
  {
    return implementation->direct ? implementation->direct->reciprocal_condition()
                                  : std::numeric_limits<double>::quiet_NaN();
  }

  double LinearSolver::fill() const
  {
    return implementation->direct ? implementation->direct->fill()
                                  : implementation->iterative->fill();
  }
} // namespace meltfront::particles
