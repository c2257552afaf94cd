#ifndef meltfront_verification_measure_formulas_square_law_h
#define meltfront_verification_measure_formulas_square_law_h

#include <span>

namespace meltfront::verification
{
  /** A straight line through the squares of a front's positions over time. */
  struct SquareLaw
  {
    double slope = 0;         ///< d(X^2)/dt (m^2/s)
    double r_squared = 0;     ///< share of the variance that the line explains
    double largest_error = 0; ///< from the line, over the last square
    int points = 0;           ///< that were fitted
  };

  /**
   * Fit X^2 = a + slope t by least squares over all times from the first one on at which
   * the front has reached `from`. NaN where fewer than ten points are left.
   * @param time ascending (s)
   * @param front X (m), NaN where there is none
   */
  SquareLaw square_law(std::span<const double> time, std::span<const double> front,
                       double from);
} // namespace meltfront::verification

#endif
