#ifndef meltfront_cases_exact_heat_quadrature_h
#define meltfront_cases_exact_heat_quadrature_h

#include <cases/position.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <numbers>

namespace meltfront::cases
{
  /** Surface at a coordinate in the measure of a symmetry: 1, 2 pi r, 4 pi r^2. */
  inline double surface(Symmetry symmetry, double r)
  {
    switch(symmetry)
    {
    case Symmetry::cylindrical:
      return 2 * std::numbers::pi * r;
    case Symmetry::spherical:
      return 4 * std::numbers::pi * r * r;
    default:
      return 1;
    }
  }

  /**
   * Integral of f over lower <= r <= upper in the measure of a symmetry, by Gauss
   * quadrature with 20 points on panels.
   *
   * @param panel_width  width of the panel that begins at a coordinate; 20 points are
   * exact to round-off where f varies by a few e-folds over it and has no singularity
   * closer than its width
   */
  template <typename Function, typename Width>
  double integrate_panels(Symmetry symmetry, double lower, double upper,
                          const Function &f, const Width &panel_width)
  {
    double sum = 0;
    for(double left = lower; left < upper;)
    {
      const double right = std::min(upper, left + panel_width(left));
      sum += boost::math::quadrature::gauss<double, 20>::integrate(
          [&](double r) { return surface(symmetry, r) * f(r); }, left, right);
      left = right;
    }
    return sum;
  }
} // namespace meltfront::cases

#endif
