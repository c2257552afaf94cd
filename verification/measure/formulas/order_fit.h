#ifndef meltfront_verification_measure_formulas_order_fit_h
#define meltfront_verification_measure_formulas_order_fit_h

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What a sequence of errors looks like. */
  enum class OrderVerdict
  {
    clean,             ///< falls along a straight line in the log-log diagram
    stagnating,        ///< falls at first and then hardly any more, or not at all
    oscillating,       ///< scatters about its line so that single rates mean nothing
    diverging,         ///< grows on finer resolutions
    suspiciously_fast, ///< faster than the scheme can be
    too_few_levels,    ///< fewer than four different resolutions
    not_finite,        ///< holds a NaN or an infinite or negative value
    zero_error         ///< holds an error of exactly zero: nothing was measured
  };

  /** A verdict in words, e.g. `suspiciously fast`. */
  const char *to_string(OrderVerdict verdict);

  /** An exponent fitted to errors, E = C h^p. */
  struct OrderFit
  {
    double order = std::numeric_limits<double>::quiet_NaN(); ///< p
    /** Of the order; NaN for fewer than three levels. */
    double standard_error = std::numeric_limits<double>::quiet_NaN();
    /** Half the width of its 95 % confidence interval: Student's t quantile of m - 2
     * degrees of freedom times the standard error (4.3 of it for four levels). */
    double confidence = std::numeric_limits<double>::quiet_NaN();
    double factor = std::numeric_limits<double>::quiet_NaN(); ///< C
    int levels = 0;   ///< different resolutions that were fitted
    int left_out = 0; ///< levels at or below the round-off floor, which were not
    /** ln(E_i/E_{i+1})/ln(h_i/h_{i+1}) between neighbouring levels, coarse to fine. A
     * detail: on a fixed grid they swing, because the front moves inside a cell. */
    std::vector<double> pairwise;
    OrderVerdict verdict = OrderVerdict::too_few_levels;

    /**
     * `h^1.47 +- 0.04`, the confidence, followed in brackets by remarks(), if there are
     * any, e.g. `h^0.31 +- 0.12 (stagnating)`; `none (contains NaN)` where there is no
     * order.
     */
    std::string text(const std::string &base = "h") const;

    /** The verdict unless it is clean, and how many levels were left out: `stagnating; 2
     * levels at round-off left out`. */
    std::string remarks() const;
  };

  /**
   * Fit the exponent of errors against resolution by least squares in the logarithms.
   *
   * The standard error is sqrt(sum r^2 / ((m - 2) sum (x - mean x)^2)) with the residuals
   * r of ln E and x = ln h over m levels. Of errors given for the same h, as those of
   * several seeds, the geometric mean is taken first.
   *
   * The verdicts, in this order: not_finite and zero_error leave the order NaN;
   * too_few_levels for fewer than four levels (the order is still given for two or
   * three); diverging for an order below -0.2; oscillating if the error grows by a rate
   * below -0.25 somewhere, or scatters about the line by more than 0.25 (root mean square
   * of ln E); stagnating for an order below 0.2, or if the rate over the three finest
   * levels is less than 0.7 of that over the three coarsest; suspiciously_fast if the
   * order exceeds `plausible_order` by more than its confidence; else clean.
   *
   * @param h resolutions, any order
   * @param errors one for each h
   * Levels whose error is at or below the round-off floor say nothing of the scheme: they
   * are left out and counted. An error of exactly zero is at round-off only where no
   * finer level is above the floor; elsewhere it stays a zero_error.
   *
   * @param plausible_order the highest order that the scheme can have
   * @param round_off_floor in the unit of the errors
   */
  OrderFit fit_order(std::span<const double> h, std::span<const double> errors,
                     double plausible_order = 3, double round_off_floor = 0);
} // namespace meltfront::verification

#endif
