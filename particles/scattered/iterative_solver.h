#ifndef meltfront_particles_scattered_iterative_solver_h
#define meltfront_particles_scattered_iterative_solver_h

#include <particles/scattered/linear_solver.h>

#include <memory>
#include <span>

namespace meltfront::particles
{
  /** Krylov methods of Trilinos' Belos, preconditioned by Ifpack (diagonal, incomplete LU
   * with threshold) or ML (smoothed aggregation; Vanek, Mandel and Brezina 1996). */
  class IterativeSolver
  {
  public:
    IterativeSolver(const CompressedRows &matrix, LinearMethod method,
                    const LinearSolverParameters &parameters);
    ~IterativeSolver();

    LinearSolver::Outcome solve(std::span<const double> right_hand_side,
                                std::span<double> x);

    /** Entries of the preconditioner over those of the matrix. */
    double fill() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace meltfront::particles

#endif
