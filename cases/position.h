#ifndef meltfront_cases_position_h
#define meltfront_cases_position_h

#include <array>
#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  /** A point of space (m); coordinates beyond the scene's dimension are zero. */
  using Position = std::array<double, 3>;

  /** What a scene's solution depends on: x, distance from an axis, distance from a point,
   * or all. */
  enum class Symmetry
  {
    planar,
    cylindrical,
    spherical,
    none
  };

  /** The one coordinate that a symmetric solution depends on; x for Symmetry::none. */
  inline double coordinate(Symmetry symmetry, const Position &p)
  {
    switch(symmetry)
    {
    case Symmetry::cylindrical:
      return std::hypot(p[0], p[1]);
    case Symmetry::spherical:
      return std::hypot(p[0], p[1], p[2]);
    default:
      return p[0];
    }
  }

  /** Volume between two coordinates: length, pi r^2 or 4/3 pi r^3 differences (m, m^2,
   * m^3). */
  inline double volume_between(Symmetry symmetry, double lower, double upper)
  {
    switch(symmetry)
    {
    case Symmetry::cylindrical:
      return std::numbers::pi * (upper - lower) * (upper + lower);
    case Symmetry::spherical:
      return 4. / 3. * std::numbers::pi * (upper - lower)
             * (upper * upper + upper * lower + lower * lower);
    default:
      return upper - lower;
    }
  }

  /** Inverse of volume_between(symmetry, 0, r): the coordinate that encloses a volume. */
  inline double enclosing_coordinate(Symmetry symmetry, double volume)
  {
    switch(symmetry)
    {
    case Symmetry::cylindrical:
      return std::sqrt(volume / std::numbers::pi);
    case Symmetry::spherical:
      return std::cbrt(0.75 * volume / std::numbers::pi);
    default:
      return volume;
    }
  }
} // namespace meltfront::cases

#endif
