#ifndef meltfront_particles_scattered_linear_solver_h
#define meltfront_particles_scattered_linear_solver_h

#include <particles/scattered/compressed_rows.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace meltfront::particles
{
  /** How a sparse linear system is solved. */
  enum class LinearMethod
  {
    automatic,      ///< direct for small systems, multigrid for large ones; where
                    ///< iterations fail, stronger factors
    direct,         ///< UMFPACK of SuiteSparse (Davis 2004)
    gmres_ilut,     ///< GMRES, incomplete LU factors with a threshold (Saad 1994)
    cg_jacobi,      ///< conjugate gradients with the diagonal, symmetric matrices only
    cg_multigrid,   ///< with smoothed aggregation, symmetric matrices only
    gmres_multigrid ///< GMRES with smoothed aggregation
  };

  /** The words for them, in the order of the enumeration. */
  const std::vector<std::string> &linear_method_names();

  struct LinearSolverParameters
  {
    LinearMethod method = LinearMethod::automatic;
    double tolerance = 1e-12; ///< of the residual over the right-hand side
    int most_iterations = 2000;
    double ilut_fill = 5; ///< entries of the incomplete factors over the matrix's
    double drop_tolerance
        = 1e-3;             ///< entries of the factors below it, relative, are left out
    bool symmetric = false; ///< positive definite, too
    int dimension = 2;      ///< of space: what `automatic` goes by
  };

  /** The method that `automatic` stands for with so many unknowns; others as asked for.
   */
  LinearMethod chosen_method(std::size_t unknowns,
                             const LinearSolverParameters &parameters);

  /**
   * One matrix, factorised or preconditioned once and solved for many right-hand sides.
   * Every row is scaled by its largest entry first, unless the matrix is symmetric.
   */
  class LinearSolver
  {
  public:
    /** @throws cases::InputError if the method does not fit the matrix. */
    LinearSolver(const CompressedRows &matrix, const LinearSolverParameters &parameters);
    ~LinearSolver();
    LinearSolver(LinearSolver &&) noexcept;
    LinearSolver &operator=(LinearSolver &&) noexcept;

    struct Outcome
    {
      bool converged = false;
      int iterations = 0;  ///< 0 of a direct method
      double residual = 0; ///< |b - A x| / |b| of the scaled rows, in the 2-norm
    };

    /** x is the first guess of iterative methods. */
    Outcome solve(std::span<const double> right_hand_side, std::span<double> x);

    LinearMethod method() const; ///< that `automatic` has come to

    /** Estimate of the reciprocal condition number that the direct method gives, over the
     * scaled rows; NaN of the others. Near 1e-16: singular. */
    double reciprocal_condition() const;

    /** Entries of the factors or of the preconditioner over those of the matrix. */
    double fill() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace meltfront::particles

#endif
