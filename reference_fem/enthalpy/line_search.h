#ifndef meltfront_reference_fem_enthalpy_line_search_h
#define meltfront_reference_fem_enthalpy_line_search_h

#include <cmath>

namespace meltfront::reference_fem
{
  /**
   * The share of a direction at which a convex functional's derivative along it, which
   * rises, has nearly vanished: one where the derivative is small there already, else by
   * the Illinois form of the rule of false position.
   *
   * @param start the derivative at no share
   * @param fall the derivative at a share
   */
  template <typename Fall>
  double nearly_lowest(double start, const Fall &fall)
  {
    constexpr double enough = 0.1;
    constexpr int most_trials = 30;
    double upper_value = fall(1.);
    if(!(start < 0) || upper_value <= enough * -start)
      return 1;
    double lower = 0, upper = 1, lower_value = start;
    for(int trial = 0; trial < most_trials; ++trial)
    {
      const double middle
          = (lower * upper_value - upper * lower_value) / (upper_value - lower_value);
      const double value = fall(middle);
      if(std::abs(value) <= enough * -start)
        return middle;
      if(value < 0)
      {
        lower = middle;
        lower_value = value;
        upper_value /= 2;
      }
      else
      {
        upper = middle;
        upper_value = value;
        lower_value /= 2;
      }
    }
    return lower > 0 ? lower : upper;
  }
} // namespace meltfront::reference_fem

#endif
