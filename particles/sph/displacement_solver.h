#ifndef meltfront_particles_sph_displacement_solver_h
#define meltfront_particles_sph_displacement_solver_h

#include <particles/sph/conduction_rows.h>

#include <memory>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Where liquid goes that has to make room: the potential phi with
   *
   *   sum_b g_ab (phi_a - phi_b) + l_a phi_a = due_a
   *
   * over the particles that hold liquid, g the coefficients of pairs, l those of links to
   * the outlet, where phi is zero; particles without liquid let nothing pass.
   *
   * Conjugate gradients, preconditioned by Cholesky factors of the same matrix as it was
   * when they were last computed: of the particles that have frozen or melted since, each
   * costs an iteration or two, and when these are no longer few the factors are renewed.
   * In the plane they are complete; in space, where that fills them up, incomplete (Lin
   * and More 1999, as in Eigen).
   */
  class DisplacementSolver
  {
  public:
    /** @param links by particle, zero away from the outlet */
    DisplacementSolver(const ParticleOperator &rows, std::vector<double> links,
                       int dimension, int threads);
    ~DisplacementSolver();
    DisplacementSolver(const DisplacementSolver &) = delete;
    DisplacementSolver &operator=(const DisplacementSolver &) = delete;

    /**
     * Solve for the potential, starting from the one at hand.
     * @param liquid 1 for particles that hold liquid, 0 for others; padded
     * @param due volumes to be displaced; what is left over of them afterwards
     * @param tolerance of the sum of what is left over
     * @return whether that was reached.
     */
    bool solve(std::span<const double> liquid, std::span<double> due,
               std::span<double> potential, double tolerance);

    /** Of all solutions so far. */
    long iterations() const
    {
      return iterations_made;
    }

    std::size_t bytes() const;

  private:
    class Factors;

    void apply(std::span<const double> liquid, std::span<const double> potential,
               std::span<double> result) const;
    void renew_factors(std::span<const double> liquid);
    void precondition(std::span<const double> liquid);

    const ParticleOperator &rows;
    std::vector<double> links;
    int threads;
    std::unique_ptr<Factors> factors;
    long iterations_made = 0;
    int with_new_factors = 0; ///< iterations
    std::vector<double> residual, direction, product, smoothed;
  };
} // namespace meltfront::particles

#endif
