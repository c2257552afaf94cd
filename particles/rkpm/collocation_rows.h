#ifndef meltfront_particles_rkpm_collocation_rows_h
#define meltfront_particles_rkpm_collocation_rows_h

#include <particles/rkpm/reproducing_weights.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm
{
  /** What is demanded of u at a point: value u + gradient . grad u + laplacian lap u. */
  struct RowCoefficients
  {
    double value = 0;
    std::array<double, 3> gradient{};
    double laplacian = 0;
  };

  /** div(k grad u) = k lap u + grad k . grad u; k in W/(m K), grad k in W/(m^2 K). */
  RowCoefficients conduction_row(double conductivity,
                                 const std::array<double, 3> &conductivity_gradient = {});

  /** The reconstructed value, sum_I N_I u_I = g. */
  RowCoefficients dirichlet_row();

  /** k du/dn, the heat that flows in (W/m^2), for the outward unit normal. */
  RowCoefficients neumann_row(double conductivity, const std::array<double, 3> &normal);

  /** k du/dn + h u, which is h times the temperature of the surroundings; the
   * coefficient of heat transfer h in W/(m^2 K). */
  RowCoefficients robin_row(double conductivity, double transfer,
                            const std::array<double, 3> &normal);

  /** A sparse matrix in compressed rows, each divided by its largest entry. */
  struct CompressedRows
  {
    std::vector<std::size_t> offsets;   ///< of each row's first entry; rows + 1 of them
    std::vector<std::uint32_t> columns; ///< ascending in each row
    std::vector<double> coefficients;   ///< the largest of a row has magnitude 1
    std::vector<double> scale;          ///< by which a row's right side is multiplied

    std::size_t rows() const
    {
      return scale.size();
    }

    /** result = matrix * values, of the scaled rows. */
    void apply(std::span<const double> values, std::span<double> result) const;
  };

  /**
   * One row for each point of the weights.
   * @throws cases::InputError if there is not one set of coefficients for each point, or
   *         if second derivatives are wanted whose weights were not computed.
   * @throws cases::NumericalError if a row is empty of effect or not finite.
   */
  CompressedRows collocation_rows(const ReproducingWeights &weights,
                                  std::span<const RowCoefficients> coefficients);
} // namespace meltfront::particles::rkpm

#endif
