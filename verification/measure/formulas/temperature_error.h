#ifndef meltfront_verification_measure_formulas_temperature_error_h
#define meltfront_verification_measure_formulas_temperature_error_h

#include <cases/exact_solution.h>
#include <cases/snapshot.h>

#include <span>

namespace meltfront::verification
{
  /** Errors of the temperature at one time, without a unit; NaN where there is no site to
   * compare or nothing to relate to. */
  struct TemperatureError
  {
    /** sqrt(sum w (T - T_exact)^2 / sum w (T_exact - T_m)^2) with the sites' volumes w */
    double l2;
    /** max |T - T_exact| / max |T_exact - T_m| */
    double maximum;
    /**
     * sqrt(sum (T - T_exact)^2 / N) / max |T_exact| over the N sites: Erickson et al.
     * 2016 (SAND2016-9800), eq. (2.31). As defined there it depends on the zero of the
     * temperature scale.
     */
    double rmse;
    /** sqrt(sum (T - T_exact)^2 / sum (T_exact - T_m)^2), each site counted once: what
     * section 5 of the same report measures. */
    double sites_l2;
  };

  /** The exact temperature at a site; of a solution with a front at its coordinate. */
  double exact_temperature(const cases::ExactSolution &exact,
                           const cases::Snapshot &snapshot, double coordinate,
                           std::size_t site);

  /**
   * Compare the temperature of a snapshot with the exact one at the snapshot's time.
   *
   * Compared are sites with a volume whose coordinate lies between `from` and `to` (m)
   * and at which the exact temperature is finite (it is not at a line or point sink).
   *
   * @param coordinates of the sites (x or r, m)
   */
  TemperatureError temperature_error(const cases::Snapshot &snapshot,
                                     std::span<const double> coordinates,
                                     const cases::ExactSolution &exact,
                                     double melting_temperature, double from, double to);
} // namespace meltfront::verification

#endif
