#include <particles/sph/wall_values.h>

#include <algorithm>
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
        place[0]
            = std::llround(cases::coordinate(scene.symmetry, point.position) / grain);
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
  }

  void WallValues::evaluate(double time, std::vector<double> &values) const
  {
    for(std::size_t p = 0; p < points.size(); ++p)
      values[p] = points[p].boundary->value(points[p].position, time);
  }

  void WallValues::prepare_step(double begin, double end)
  {
    if(constant)
    {
      if(std::isnan(last_time))
      {
        evaluate(begin, first);
        last = first;
      }
      last_time = end;
      return;
    }
    if(last_time == begin)
      std::swap(first, last);
    else
      evaluate(begin, first);
    evaluate(end, last);
    last_time = end;
  }

  std::size_t WallValues::bytes() const
  {
    return points.size() * (sizeof(WallPoint) + 2 * sizeof(double));
  }
} // namespace meltfront::particles
