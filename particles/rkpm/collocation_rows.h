#ifndef meltfront_particles_rkpm_collocation_rows_h
#define meltfront_particles_rkpm_collocation_rows_h

#include <particles/rkpm/reproducing_weights.h>
#include <particles/scattered/compressed_rows.h>

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

  /** k du/dn + h u, which is h times the temperature of the surroundings; the
   * coefficient of heat transfer h in W/(m^2 K). */
  RowCoefficients robin_row(double conductivity, double transfer,
                            const std::array<double, 3> &normal);

  /**
   * Append the entries of a row at a point: numbers of its neighbours, and what each
   * contributes.
   * @throws cases::NumericalError if the row has no effect or is not finite.
   */
  void collect_row(const ReproducingWeights &weights, std::size_t point,
                   const RowCoefficients &coefficients,
                   std::vector<std::uint32_t> &columns, std::vector<double> &values);

  /**
   * One row for each point of the weights.
   * @throws cases::InputError if there is not one set of coefficients for each point, or
   *         if second derivatives are wanted whose weights were not computed.
   * @throws cases::NumericalError as collect_row() does.
   */
  CompressedRows collocation_rows(const ReproducingWeights &weights,
                                  std::span<const RowCoefficients> coefficients);
} // namespace meltfront::particles::rkpm

#endif
