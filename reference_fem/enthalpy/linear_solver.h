#ifndef meltfront_reference_fem_enthalpy_linear_solver_h
#define meltfront_reference_fem_enthalpy_linear_solver_h

#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/lattice.h>
#include <reference_fem/enthalpy/nested_level.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace meltfront::reference_fem
{
  /** The linear system of a Newton iteration: (D + c K) x = r on the active nodes. */
  struct NewtonSystem
  {
    const std::vector<double> &heat_capacity; ///< D: volume times dH/du (J per unit of u)
    double step_factor;                       ///< c (s)
    const std::vector<char> &active;          ///< x is zero where this is 0
    const std::vector<double> &residual;      ///< r (J)
    double sufficient_residual; ///< norm of r - (D + c K) x below which x is exact enough
  };

  /** Solves the symmetric positive definite systems of the truncated Newton method. */
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /** Its name for the report. */
    virtual std::string description() const = 0;

    /** Reduce the residual by the given factor; direct solvers ignore it. */
    virtual void solve(const NewtonSystem &system, double reduction,
                       std::vector<double> &x)
        = 0;

    /** To be called after the conductances of the matrix have changed. */
    virtual void conductances_changed()
    {
    }

    /** Matrix entries touched since the start. */
    long work() const
    {
      return entries_touched;
    }

    /** Iterations since the start; none of direct solvers. */
    long iterations() const
    {
      return linear_iterations;
    }

  protected:
    long entries_touched = 0;
    long linear_iterations = 0;
  };

  /** Elimination for chains of nodes (one dimension), nodes numbered along the chain. */
  std::unique_ptr<LinearSolver> make_tridiagonal_solver(const ConductionMatrix &matrix);

  /** How conjugate gradients are preconditioned. */
  enum class Preconditioner
  {
    automatic, ///< multigrid on lattices, else by unknowns and Fourier number
    ssor,
    amg ///< smoothed aggregation of Trilinos ML
  };

  /** Conjugate gradients for two and three dimensions, on one thread. */
  std::unique_ptr<LinearSolver> make_krylov_solver(const ConductionMatrix &matrix,
                                                   Preconditioner preconditioner);

  /** From the finest level, that of the nodes, to the coarsest. */
  using Levels = std::variant<std::vector<LatticeLevel>, std::vector<NestedLevel>>;

  /** None where there are no levels. */
  inline std::size_t n_levels(const Levels *levels)
  {
    return levels
               ? std::visit([](const auto &of_kind) { return of_kind.size(); }, *levels)
               : 0;
  }

  /** The same, preconditioned by Multigrid. @param levels of the nodes */
  std::unique_ptr<LinearSolver>
  make_multigrid_solver(const ConductionMatrix &matrix,
                        const std::shared_ptr<const Levels> &levels);
} // namespace meltfront::reference_fem

#endif
