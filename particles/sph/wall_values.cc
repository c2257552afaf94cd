#include <particles/sph/wall_values.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace meltfront::particles
{
  namespace
  {
    /** Equal for points whose values cannot differ. */
    using Key = std::tuple<const cases::Boundary *, std::array<std::int64_t, 3>>;

    Key key(const cases::Scene &scene, const WallPoint &point)
    {
      const double grain = 1e-10 * scene.domain.side();
      std::array<std::int64_t, 3> place{};
      if(point.boundary->value.constant)
        return {point.boundary, place};
      if(point.boundary->exact && scene.symmetry != cases::Symmetry::none)
      {
        // Of a wall that bends all coordinates are one, but for their rounding; on others
        // a value must not depend on which of its points comes first.
        const double coordinate = cases::coordinate(scene.symmetry, point.position);
        place[0] = scene.domain.round() ? std::llround(coordinate / grain)
                                        : std::bit_cast<std::int64_t>(coordinate);
        return {point.boundary, place};
      }
      // A slab has no more coordinates than one.
      const int dimension = scene.domain.dimension;
      for(int d = 0; d < dimension; ++d)
        place[d] = std::llround(point.position[d] / grain);
      return {point.boundary, place};
    }
  } // namespace

  WallValues::WallValues(const cases::Scene &scene,
                         const std::vector<WallPoint> &all_points,
                         std::vector<WallLink> &links)
    : last_time(std::numeric_limits<double>::quiet_NaN())
    , constant(std::all_of(all_points.begin(), all_points.end(),
                           [](const WallPoint &point)
                           { return point.boundary->value.constant; }))
  {
    std::map<Key, std::uint32_t> numbers;
    std::vector<std::uint32_t> number_of;
    for(const WallPoint &point : all_points)
    {
      const auto [found, inserted]
          = numbers.try_emplace(key(scene, point), points.size());
      if(inserted)
      {
        points.push_back(point);
        for(int d = scene.domain.dimension; d < 3; ++d)
          points.back().position[d] = 0;
      }
      number_of.push_back(found->second);
    }
    for(WallLink &link : links)
      link.point = number_of[link.point];
    first.resize(points.size());
    last.resize(points.size());
    std::map<const cases::Boundary *, std::size_t> mean_of_boundary;
    for(const WallPoint &point : points)
    {
      const auto [found, inserted]
          = mean_of_boundary.try_emplace(point.boundary, means.size());
      if(inserted)
        means.emplace_back(point.boundary->value);
      mean_of_point.push_back(found->second);
    }
  }

  bool WallValues::holds_constants(double begin, double end)
  {
    if(constant && std::isnan(last_time))
    {
      for(std::size_t p = 0; p < points.size(); ++p)
        first[p] = points[p].boundary->value(points[p].position, begin);
      last = first;
    }
    if(constant)
      last_time = end;
    return constant;
  }

  void WallValues::prepare_step(double begin, double end)
  {
    if(holds_constants(begin, end))
      return;
    const bool goes_on = last_time == begin;
    for(std::size_t p = 0; p < points.size(); ++p)
    {
      const cases::Field &value = points[p].boundary->value;
      const cases::Position &position = points[p].position;
      first[p] = goes_on && !cases::breaks_at(value, begin)
                     ? last[p]
                     : cases::value_at_begin(value, position, begin, end);
      last[p] = cases::value_at_end(value, position, begin, end);
    }
    last_time = end;
  }

  void WallValues::average_step(double begin, double end)
  {
    if(holds_constants(begin, end))
      return;
    for(std::size_t p = 0; p < points.size(); ++p)
      first[p] = last[p] = means[mean_of_point[p]](points[p].position, begin, end);
  }

  std::size_t WallValues::bytes() const
  {
    return points.size() * (sizeof(WallPoint) + sizeof(std::size_t) + 2 * sizeof(double));
  }
} // namespace meltfront::particles
