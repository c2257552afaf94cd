#include <cases/exact_solution.h>

#include <algorithm>
#include <limits>

namespace meltfront::cases
{
  double ExactSolution::solid_fraction(double coordinate, double time) const
  {
    return (coordinate < front(time)) == solid_at_origin() ? 1 : 0;
  }

  double ExactSolution::solid_volume(double lower, double upper, double time) const
  {
    const double split = std::clamp(front(time), lower, upper);
    return solid_at_origin() ? volume_between(symmetry(), lower, split)
                             : volume_between(symmetry(), split, upper);
  }

  double ExactSolution::solid_volume(double) const
  {
    return std::numeric_limits<double>::quiet_NaN();
  }

  double ExactSolution::front_area(double) const
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
} // namespace meltfront::cases
