#include <cases/exact/heat_quadrature.h>
#include <cases/exact/layered_solution.h>
#include <cases/numbers.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    /** How many fronts lie at or before a coordinate. */
    std::ptrdiff_t layer_of(const std::vector<double> &fronts, double coordinate)
    {
      return std::ranges::upper_bound(fronts, coordinate) - fronts.begin();
    }
  } // namespace

  bool LayeredSolution::has_front() const
  {
    return !fronts(start_time()).empty();
  }

  bool LayeredSolution::depends_on_one_coordinate() const
  {
    return fronts(start_time()).size() == 1;
  }

  double LayeredSolution::front(double time) const
  {
    const std::vector<double> all = fronts(time);
    if(all.size() <= 1)
      return all.empty() ? nan : all.front();
    const double solid = solid_volume(inner(), outer(), time);
    const double at_origin = solid_at_origin()
                                 ? solid
                                 : volume_between(symmetry(), inner(), outer()) - solid;
    return symmetry() == Symmetry::planar
               ? inner() + at_origin
               : enclosing_coordinate(symmetry(),
                                      volume_between(symmetry(), 0, inner()) + at_origin);
  }

  double LayeredSolution::solid_fraction(double coordinate, double time) const
  {
    return (layer_of(fronts(time), coordinate) % 2 == 0) == solid_at_origin() ? 1 : 0;
  }

  double LayeredSolution::solid_volume(double lower, double upper, double time) const
  {
    double volume = 0, left = lower;
    bool solid = solid_at_origin();
    const auto close_layer = [&](double end)
    {
      const double right = std::clamp(end, lower, upper);
      if(solid)
        volume += volume_between(symmetry(), left, right);
      left = right;
      solid = !solid;
    };
    for(const double front : fronts(time))
      close_layer(front);
    close_layer(upper);
    return volume;
  }

  double LayeredSolution::solid_volume(double time) const
  {
    return solid_volume(inner(), outer(), time);
  }

  double LayeredSolution::front_area(double time) const
  {
    double area = 0;
    for(const double front : fronts(time))
      area += surface(symmetry(), front);
    return area;
  }

  double LayeredSolution::signed_distance(const Position &position, double time) const
  {
    const std::vector<double> all = fronts(time);
    const double r = coordinate(symmetry(), position);
    double distance = std::numeric_limits<double>::infinity();
    for(const double front : all)
      distance = std::min(distance, std::abs(r - front));
    return (layer_of(all, r) % 2 == 0 ? -1 : 1) * distance;
  }

  std::vector<double> fronts_of(const ExactSolution &solution, double time)
  {
    if(const auto *layered = dynamic_cast<const LayeredSolution *>(&solution))
      return layered->fronts(time);
    return {solution.front(time)};
  }
} // namespace meltfront::cases
