#ifndef meltfront_cases_exact_wall_layer_h
#define meltfront_cases_exact_wall_layer_h

#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  /**
   * The layer of heat that forms at a wall from a moment on: its temperature jumps, or
   * its flux is not what is conducted there. In the distance x from it, in a half-space
   * of the diffusivity a, after the time t,
   *
   *   T - T_before = jump erfc(x/l) + slope l ierfc(x/l),  l = 2 sqrt(a t),
   *
   * with ierfc(x) = exp(-x^2)/sqrt(pi) - x erfc(x): -dT/dx at the wall is the slope
   * (Carslaw & Jaeger 1959, sections 2.5 and 2.9).
   */
  struct WallLayer
  {
    double jump = 0;  ///< K
    double slope = 0; ///< K/m

    bool forms() const
    {
      return jump != 0 || slope != 0;
    }

    /** T - T_before. @param distance x (m); @param thickness l > 0 (m) */
    double temperature(double distance, double thickness) const
    {
      // erfc(20) is 5e-176, and what is left of it is no number.
      constexpr double layers_until_nothing = 20;
      const double x = distance / thickness;
      if(!forms() || x > layers_until_nothing)
        return 0;
      const double erfc = std::erfc(x);
      return jump * erfc
             + slope * thickness
                   * (std::exp(-x * x) / std::sqrt(std::numbers::pi) - x * erfc);
    }
  };
} // namespace meltfront::cases

#endif
