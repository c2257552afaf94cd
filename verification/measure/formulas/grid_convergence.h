#ifndef meltfront_verification_measure_formulas_grid_convergence_h
#define meltfront_verification_measure_formulas_grid_convergence_h

#include <limits>
#include <span>

namespace meltfront::verification
{
  /** How far a value can be trusted where no exact solution exists. */
  struct GridConvergence
  {
    double order = std::numeric_limits<double>::quiet_NaN(); ///< observed
    double extrapolated
        = std::numeric_limits<double>::quiet_NaN(); ///< Richardson's limit
    /** Grid convergence index of the finest value: 1.25 |f - limit|, in the value's unit.
     */
    double uncertainty = std::numeric_limits<double>::quiet_NaN();
    /** The three values approach their limit from one side and ever more slowly. */
    bool monotone = false;
  };

  /**
   * Richardson extrapolation and grid convergence index from the three finest values.
   *
   * With f_1 (finest), f_2, f_3 at h_1 < h_2 < h_3, r_21 = h_2/h_1, r_32 = h_3/h_2, the
   * order p solves (f_3 - f_2)/(f_2 - f_1) = r_21^p (r_32^p - 1)/(r_21^p - 1); the limit
   * is f_1 + (f_1 - f_2)/(r_21^p - 1); the index is 1.25 |f_1 - limit| (Roache 1994;
   * Celik et al. 2008, the procedure of the Journal of Fluids Engineering, for unequal
   * ratios).
   *
   * Values that do not approach a limit monotonically have no order: `monotone` is false,
   * the limit NaN, and the uncertainty three times the spread of the three values.
   * Values that are equal have converged: limit f_1, uncertainty 0, order NaN.
   *
   * @throws InputError for fewer than three different positive h.
   */
  GridConvergence extrapolate(std::span<const double> h, std::span<const double> values);
} // namespace meltfront::verification

#endif
