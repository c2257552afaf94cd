#ifndef meltfront_particles_sph_time_krylov_solver_h
#define meltfront_particles_sph_time_krylov_solver_h

#include <functional>
#include <memory>
#include <span>

namespace meltfront::particles
{
  /**
   * Solves linear systems whose matrix is known by its products with vectors only:
   * BiCGStab (van der Vorst 1992) of Trilinos' Belos, preconditioned by the matrix's
   * diagonal. It keeps no growing basis, whose orthogonalisation costs more than these
   * products do.
   * All sums run in a fixed order.
   */
  class KrylovSolver
  {
  public:
    /** result = matrix * vector, of as many entries as there are unknowns. */
    using Product
        = std::function<void(std::span<const double> vector, std::span<double> result)>;

    KrylovSolver(std::size_t unknowns, Product product);
    ~KrylovSolver();
    KrylovSolver(const KrylovSolver &) = delete;
    KrylovSolver &operator=(const KrylovSolver &) = delete;

    struct Outcome
    {
      bool converged;
      int iterations; ///< 0 if there is no solution: x is then as it was
    };

    /**
     * Solve matrix * x = right_hand_side from x = 0.
     * @param diagonal of the matrix, no entry zero
     * @param tolerance of the residual over the right-hand side, in the Euclidean norm
     */
    Outcome solve(std::span<const double> diagonal,
                  std::span<const double> right_hand_side, std::span<double> x,
                  double tolerance, int most_iterations);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace meltfront::particles

#endif
