#ifndef meltfront_particles_rkpm_tracked_line_measure_h
#define meltfront_particles_rkpm_tracked_line_measure_h

#include <cases/scene.h>

#include <array>
#include <numbers>

namespace meltfront::particles::rkpm_tracked
{
  /** Area of a cut across a line, in the measure of the scene. */
  inline double area(cases::Symmetry symmetry, double x)
  {
    switch(symmetry)
    {
    case cases::Symmetry::cylindrical:
      return 2 * std::numbers::pi * x;
    case cases::Symmetry::spherical:
      return 4 * std::numbers::pi * x * x;
    default:
      return 1;
    }
  }

  /** What the values at two points count for in the integral of the straight line between
   * them, by two points of Gauss: exact in up to three dimensions. */
  inline std::array<double, 2> end_volumes(cases::Symmetry symmetry, double a, double b)
  {
    constexpr double offset = 0.5 / std::numbers::sqrt3;
    std::array<double, 2> sum{};
    for(const double s : {0.5 - offset, 0.5 + offset})
    {
      const double cut = area(symmetry, a + s * (b - a)) * (b - a) / 2;
      sum[0] += cut * (1 - s);
      sum[1] += cut * s;
    }
    return sum;
  }
} // namespace meltfront::particles::rkpm_tracked

#endif
