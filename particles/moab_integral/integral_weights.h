#ifndef meltfront_particles_moab_integral_integral_weights_h
#define meltfront_particles_moab_integral_integral_weights_h

#include <particles/moab_integral/integral_moments.h>

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace meltfront::particles
{
  /**
   * Which volumes W the particles of a row have in the sums for the integrals of
   * psi lap u and u lap psi (Erickson et al. 2016, SAND2016-9800, section 3.1.1).
   */
  enum class WeightPolicy
  {
    separate,  ///< a set W0 for psi and a set W2 for lap psi, each with its constraints
    single,    ///< one set with (3.13) and (3.14), as the report has it
    mass_only, ///< one set with (3.13) alone
    uniform    ///< the volumes of the particles
  };

  /** The words for them, in the order of the enumeration. */
  const std::vector<std::string> &weight_policy_names();

  /** What a row sees, lengths in units of its dilation; the centre is the origin. */
  struct IntegralStencil
  {
    std::vector<std::array<double, 2>> positions; ///< nearer than 1
    std::vector<double> volumes;
    /** Moments of the kernel up to degree K - 2, in the order of monomials(). */
    std::vector<double> moments;
    /** Integral of psi d(z^a)/dn over the walls whose flux stands in the row, of all
     * monomials up to degree K; empty: none. */
    std::vector<double> wall_terms;
  };

  /**
   * The coefficients of one row: with lengths in units of the dilation,
   *
   *   sum_n laplacian_n u_n + integral of psi du/dn = sum_n load_n (lap u)_n,
   *
   * laplacian_n = lap psi(z_n) W2_n, load_n = psi(z_n) W0_n. What walls do whose flux
   * does not stand in the row is absorbed in W2.
   *
   * Separate weights of order K: W0 differs least from the volumes V, in the norm
   * sum (W - V)^2 / V, among those with
   *
   *   sum psi z^a W0 = mu_a,                       |a| <= K - 2;
   *
   * W2 has the least sum W^2 / V among those with
   *
   *   sum z^a lap psi W2 = sum (lap z^a) psi W0 - integral of psi d(z^a)/dn,  |a| <= K,
   *
   * so that the row is exact for polynomials up to degree K. A single set meets (3.13),
   * sum psi W = mu_0, and (3.14), the same with W2 = W0, in the sense of least squares.
   *
   * Constraints are scaled to rows of length one and solved by a complete orthogonal
   * decomposition, singular values below 1e-12 of the largest taken for zero.
   */
  class IntegralWeights
  {
  public:
    /**
     * @param order K, 2 to 4
     * @throws cases::InputError for another order, and for the hat, which has no
     * Laplacian.
     */
    IntegralWeights(KernelShape shape, int dimension, WeightPolicy policy, int order);

    /** Number of constraints on a set of weights. */
    std::size_t n_constraints() const;

    /**
     * @return the largest residual of a constraint over the sum of the magnitudes of its
     * terms: 1e-16 to 1e-13 where all are met, order 1 where they contradict each other.
     */
    double compute(const IntegralStencil &stencil, std::span<double> laplacian,
                   std::span<double> load);

    /** Rank of the last system of constraints on the weights of lap psi. */
    long rank() const
    {
      return last_rank;
    }

  private:
    void evaluate(const IntegralStencil &stencil);
    double separate_weights(const IntegralStencil &stencil);
    double single_weights(const IntegralStencil &stencil);
    double mass_weights(const IntegralStencil &stencil);
    /** The W with matrix * W = rhs that is nearest to the reference. */
    double nearest(Eigen::VectorXd &weights);

    KernelShape shape;
    int dim;
    WeightPolicy policy;
    std::vector<Exponents> powers; ///< up to degree K
    std::size_t n_moments;         ///< of degree K - 2
    long last_rank = 0;

    std::vector<double> radii;
    std::vector<KernelProfile> profiles;
    Eigen::MatrixXd values;       ///< z^a by monomial and particle
    Eigen::MatrixXd laplacians;   ///< lap z^a
    Eigen::VectorXd psi, lap_psi; ///< of the particles
    Eigen::VectorXd volume, root; ///< and the root of the volume
    Eigen::VectorXd weights0, weights2;
    Eigen::MatrixXd matrix, scaled;
    Eigen::VectorXd rhs, reference;
  };
} // namespace meltfront::particles

#endif
