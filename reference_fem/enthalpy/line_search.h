#ifndef meltfront_reference_fem_enthalpy_line_search_h
#define meltfront_reference_fem_enthalpy_line_search_h

#include <algorithm>
#include <cmath>
#include <vector>

namespace meltfront::reference_fem
{
  /** The derivative of a convex functional along a direction, linear between kinks. */
  struct KinkedDerivative
  {
    struct Kink
    {
      double length, jump, change; ///< of the derivative, of its slope
    };

    double start = 0, slope = 0; ///< at no length
    std::vector<Kink> kinks;     ///< at lengths between 0 and 1

    /** The length between 0 and 1 at which the functional is lowest. */
    double lowest()
    {
      std::sort(kinks.begin(), kinks.end(),
                [](const Kink &a, const Kink &b) { return a.length < b.length; });
      double derivative = start, length = 0;
      for(const Kink &kink : kinks)
      {
        const double at_kink = derivative + slope * (kink.length - length);
        if(at_kink >= 0)
          break;
        derivative = at_kink + kink.jump;
        length = kink.length;
        slope += kink.change;
      }
      if(derivative >= 0)
        return length;
      return slope > 0 ? std::min(1., length - derivative / slope) : 1.;
    }

    /**
     * Add what a node contributes that goes from u along d.
     *
     * @param transfer heat lost per kelvin
     * @param heat that the balance asks of it at u
     * @param conducted what it loses along d by conduction
     */
    template <class Graph>
    void add_node(const Graph &graph, double u, double d, double volume, double transfer,
                  double heat, double conducted)
    {
      const auto rise = [&](double at)
      { return volume * graph.slope(at) + transfer * graph.excess_slope(at); };
      const double enthalpy = u == 0 && d < 0 ? 0 : graph.enthalpy(u);
      const double side = u == 0 ? d : u;
      start += d * (volume * enthalpy - heat);
      slope += d * (d * rise(side) + conducted);
      if(u * d < 0 && std::abs(u) < std::abs(d))
        kinks.push_back({-u / d, std::abs(d) * volume * graph.enthalpy(0),
                         d * d * (rise(-u) - rise(u))});
    }
  };

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
