#include <particles/sph/cell_sections.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace meltfront::particles
{
  namespace
  {
    /** The least component of a normal that tilts a plane: below it the cube's formulas
     * are differences of nearly equal numbers, and the plane is a line times an edge. */
    constexpr double least_tilt = 1e-5;

    /** Components without their signs, the largest first. */
    std::array<double, 3> sorted(const std::array<double, 3> &normal)
    {
      std::array<double, 3> n{std::abs(normal[0]), std::abs(normal[1]),
                              std::abs(normal[2])};
      std::sort(n.begin(), n.end(), std::greater<>());
      return n;
    }

    /** Volume of the unit cube below the plane n . x = height, x within [0, 1]^3, and the
     * plane's area in it (Scardovelli and Zaleski 2000): what a tetrahedron has, less
     * those beyond each edge's end. */
    std::pair<double, double> volume_and_area_below(const std::array<double, 3> &n,
                                                    double height)
    {
      double cubes = 0, squares = 0;
      for(int corner = 0; corner < 8; ++corner)
      {
        double depth = height;
        int ones = 0;
        for(int d = 0; d < 3; ++d)
          if(corner >> d & 1)
          {
            depth -= n[d];
            ++ones;
          }
        if(depth <= 0)
          continue;
        const double square = (ones % 2 == 0 ? 1 : -1) * depth * depth;
        squares += square;
        cubes += square * depth;
      }
      const double product = n[0] * n[1] * n[2];
      return {cubes / (6 * product), squares / (2 * product)};
    }
  } // namespace

  double line_through_square(double part_behind, double normal_x, double normal_y)
  {
    const double longer = std::max(std::abs(normal_x), std::abs(normal_y));
    const double shorter = std::min(std::abs(normal_x), std::abs(normal_y));
    // The chord is of constant length up to `flat`, then shrinks to a corner.
    const double flat = (longer - shorter) / 2, corner = (longer + shorter) / 2;
    const double beyond_centre = std::abs(std::clamp(part_behind, 0., 1.) - 0.5);
    const double distance
        = beyond_centre * longer <= flat
              ? beyond_centre * longer
              : corner - std::sqrt(2 * longer * shorter * (0.5 - beyond_centre));
    return std::copysign(distance, part_behind - 0.5);
  }

  double length_in_square(double distance, double normal_x, double normal_y)
  {
    const double longer = std::max(std::abs(normal_x), std::abs(normal_y));
    const double shorter = std::min(std::abs(normal_x), std::abs(normal_y));
    const double flat = (longer - shorter) / 2, corner = (longer + shorter) / 2;
    const double from_centre = std::abs(distance);
    if(from_centre <= flat)
      return 1 / longer;
    return from_centre < corner ? (corner - from_centre) / (longer * shorter) : 0;
  }

  double plane_through_cube(double part_behind, const std::array<double, 3> &normal)
  {
    const auto n = sorted(normal);
    if(n[2] < least_tilt)
      return line_through_square(part_behind, n[0], n[1]);
    const double half = (n[0] + n[1] + n[2]) / 2;
    const double beyond_centre = std::abs(std::clamp(part_behind, 0., 1.) - 0.5);
    const double part = 0.5 - beyond_centre; // by symmetry the lower half will do
    if(part <= 0)
      return std::copysign(half, part_behind - 0.5);
    constexpr int digits = 48;
    const double height = boost::math::tools::newton_raphson_iterate(
        [&](double at)
        {
          const auto [volume, area] = volume_and_area_below(n, at);
          return std::make_tuple(volume - part, area);
        },
        half - beyond_centre * n[0], 0., half, digits);
    return std::copysign(half - height, part_behind - 0.5);
  }

  double area_in_cube(double distance, const std::array<double, 3> &normal)
  {
    const auto n = sorted(normal);
    if(n[2] < least_tilt)
      return length_in_square(distance, n[0], n[1]);
    const double half = (n[0] + n[1] + n[2]) / 2, height = half - std::abs(distance);
    return height > 0 ? volume_and_area_below(n, height).second : 0;
  }
} // namespace meltfront::particles
