#include <cases/error.h>
#include <particles/greenspan/shadows.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace meltfront::particles::greenspan
{
  namespace
  {
    constexpr double whole_turn = 2 * std::numbers::pi;

    /** A set of points of a line, as disjoint intervals. */
    class Cover
    {
    public:
      /** Add an interval. @return the length of it that was not yet covered */
      double add(double begin, double end)
      {
        double uncovered = end - begin, low = begin, high = end;
        auto next = intervals.upper_bound(begin);
        if(next != intervals.begin() && std::prev(next)->second >= begin)
          --next;
        while(next != intervals.end() && next->first <= end)
        {
          uncovered -= std::min(end, next->second) - std::max(begin, next->first);
          low = std::min(low, next->first);
          high = std::max(high, next->second);
          next = intervals.erase(next);
        }
        intervals[low] = high;
        return std::max(0., uncovered);
      }

    private:
      std::map<double, double> intervals; ///< end, by begin
    };

    /** The part of an interval of angles, of less than a turn, that is not yet covered.
     */
    double add_angles(Cover &cover, double begin, double end)
    {
      const double pi = std::numbers::pi;
      if(begin < -pi)
        return cover.add(begin + whole_turn, pi) + cover.add(-pi, end);
      if(end > pi)
        return cover.add(begin, pi) + cover.add(-pi, end - whole_turn);
      return cover.add(begin, end);
    }
  } // namespace

  void require_light_radius(double radius)
  {
    if(!(radius > 0 && std::isfinite(radius)))
      throw cases::InputError(fmt::format(
          "the radius of particles in light must be positive, not {}", radius));
  }

  std::vector<std::size_t> order_of_light(const std::vector<double> &key)
  {
    std::vector<std::size_t> order(key.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&key](std::size_t i) { return key[i]; });
    return order;
  }

  std::vector<Exposure> exposure_to_point(std::span<const double> x,
                                          std::span<const double> y,
                                          const std::array<double, 2> &source,
                                          double radius)
  {
    require_light_radius(radius);
    std::vector<double> distance(x.size());
    for(std::size_t i = 0; i < x.size(); ++i)
      distance[i] = std::hypot(x[i] - source[0], y[i] - source[1]);
    std::vector<Exposure> result(x.size());
    Cover cover;
    for(const std::size_t i : order_of_light(distance))
    {
      if(distance[i] <= radius)
      {
        result[i].width = cover.add(-std::numbers::pi, std::numbers::pi);
        result[i].share = result[i].width / whole_turn;
        continue;
      }
      const double centre = std::atan2(y[i] - source[1], x[i] - source[0]);
      const double half = std::asin(radius / distance[i]);
      result[i].width = add_angles(cover, centre - half, centre + half);
      result[i].share = result[i].width / (2 * half);
    }
    return result;
  }

  std::vector<Exposure> exposure_to_rays(std::span<const double> x,
                                         std::span<const double> y,
                                         const std::array<double, 2> &direction,
                                         double radius)
  {
    require_light_radius(radius);
    const double length = std::hypot(direction[0], direction[1]);
    if(!(length > 0 && std::isfinite(length)))
      throw cases::InputError("the direction of rays must have a length");
    const double c = direction[0] / length, s = direction[1] / length;
    std::vector<double> depth(x.size());
    for(std::size_t i = 0; i < x.size(); ++i)
      depth[i] = c * x[i] + s * y[i];
    std::vector<Exposure> result(x.size());
    Cover cover;
    for(const std::size_t i : order_of_light(depth))
    {
      const double across = c * y[i] - s * x[i];
      result[i].width = cover.add(across - radius, across + radius);
      result[i].share = result[i].width / (2 * radius);
    }
    return result;
  }
} // namespace meltfront::particles::greenspan
