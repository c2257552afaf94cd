#ifndef meltfront_particles_rkpm_moment_engine_h
#define meltfront_particles_rkpm_moment_engine_h

#include <particles/core/kernel_shapes.h>
#include <particles/core/particle_storage.h>
#include <particles/rkpm/monomial_basis.h>
#include <particles/rkpm/variant.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm
{
  /** Which reproducing kernel approximation to compute. */
  struct MomentSettings
  {
    Variant variant = Variant::derivative_free;
    KernelShape kernel = KernelShape::wendland_c4;
    int dimension = 1;
    int order = 2;       ///< of the basis, 1 to 5
    int derivatives = 2; ///< highest order of derivatives wanted, 0 to 2
    Origin origin = Origin::point;
  };

  /** Below this ratio of the smallest to the largest diagonal entry of the triangular
   * factor the neighbours do not determine the polynomial. */
  inline constexpr double least_rank_ratio = 1e-8;

  /**
   * Weights of a reproducing kernel approximation at a point: N_I with
   * D^a u(x) ~ sum_I D^a N_I u_I for the value, gradient and second derivatives, exact
   * for polynomials up to the basis's order.
   *
   * All variants factor A = sqrt(w) P (a row for each neighbour, z = (x_I - x)/d, or the
   * variant's own form of the basis) by a column-pivoted Householder QR, so that M = A^T
   * A is never formed: its condition number would be that of A squared. Each derivative
   * is one more right side for the same factor.
   *
   * An engine owns its workspace: give each thread a copy. After the first points nothing
   * is allocated.
   */
  class MomentEngine
  {
  public:
    /**
     * @throws cases::InputError for an order or dimension that does not exist.
     * @throws cases::Refusal where the hat would have to be differentiated.
     */
    explicit MomentEngine(const MomentSettings &settings);

    /**
     * Compute the weights at a point.
     * @param neighbours numbers of the particles that may lie in the support
     * @param dilation radius of the kernel at the point (m); it is held fixed where the
     *        kernel is differentiated, and scales the basis
     * @param dilations radius of each particle (m), for `multiple_fixed` only
     * @return false where the neighbours do not determine the polynomial (fewer than
     *         basis functions, or a deficient rank): no weights then
     */
    bool evaluate(const std::array<double, 3> &point, const ParticleStorage &particles,
                  std::span<const std::uint32_t> neighbours, double dilation,
                  std::span<const double> dilations = {});

    /** Weights of derivative j (see MonomialBasis) of the last point, one for each of its
     * neighbours; 1/m^|a|. */
    std::span<const double> weights(int derivative) const
    {
      return {result.data() + derivative * count, count};
    }

    /** Number of derivatives: 1, 1 + dim or 1 + dim + dim (dim + 1)/2. */
    int n_derivatives() const
    {
      return derivative_numbers.size();
    }

    /** Smallest over largest diagonal entry of the last factor; 0 for too few
     * neighbours. */
    double rank_ratio() const
    {
      return ratio;
    }

    /** Condition number of the last point's moment matrix in the 2-norm, by singular
     * values; infinite if it is singular. Costs as much as many factorisations. */
    double condition_number() const;

    const MonomialBasis &basis() const
    {
      return functions;
    }

    const MomentSettings &settings() const
    {
      return how;
    }

  private:
    struct Factor;

    void find_offsets(const std::array<double, 3> &point,
                      const ParticleStorage &particles,
                      std::span<const std::uint32_t> neighbours);
    std::size_t weigh(double dilation, std::span<const std::uint32_t> neighbours,
                      std::span<const double> dilations);
    void differentiate_kernel(double dilation, std::span<const std::uint32_t> neighbours,
                              std::span<const double> dilations);
    void fill_basis(const std::array<double, 3> &point, double dilation);
    void fill_right_sides(const std::array<double, 3> &point, double dilation);
    void freeze_kernel(const Factor &factor);
    void move_kernel_with_points(const Factor &factor);
    void move_kernel_with_differences(const Factor &factor, double dilation);

    double *slope(int direction)
    {
      return kernel_derivatives.data() + (1 + direction) * count;
    }

    MomentSettings how;
    MonomialBasis functions;
    MonomialBasis derivative_numbers;
    std::array<std::array<int, 3>, 3>
        second_number{}; ///< of the derivative d^2/dx_i dx_j

    std::size_t count = 0; ///< neighbours of the last point
    double ratio = 0;
    std::array<std::vector<double>, 3> offset; ///< x_I - x
    std::vector<double> q, weight, root;       ///< distance/dilation, w, sqrt(w)
    std::vector<KernelProfile> profile;
    std::vector<double> kernel_derivatives; ///< w_i and w_ij, numbered as derivatives
    std::vector<double> columns;            ///< P
    std::vector<double> factored;           ///< its QR, in place
    std::vector<double> right_sides;
    std::vector<double> fields; ///< over the neighbours
    std::vector<double> result;
  };
} // namespace meltfront::particles::rkpm

#endif
