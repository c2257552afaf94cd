#ifndef meltfront_cases_mean_with_jumps_h
#define meltfront_cases_mean_with_jumps_h

#include <cases/position.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meltfront::cases
{
  /**
   * The mean of a function that may jump, between two points: by the trapezoidal rule,
   * in each part on ever finer halves where nearly all of the difference lies, as it does
   * about a jump and nowhere else. Of a jump it misses no more than (to - from) / parts /
   * 2^halvings; a feature that is narrower than a part may go unseen.
   */
  template <typename Function>
  double mean_with_jumps(const Function &value, double from, double to, int parts,
                         int halvings)
  {
    // Of the difference where the jump is; one half is that of what is linear and then
    // steps, and no matter for round-off.
    constexpr double rest_beside_jump = 0.5 - 1e-6;
    double left = from, at_left = value(from), sum = 0;
    const double first = at_left;
    for(int part = 1; part <= parts; ++part)
    {
      const double right = part == parts ? to : from + part * (to - from) / parts;
      const double at_right = value(right);
      double below = 0, above = 1, at_below = at_left - first,
             at_above = at_right - first;
      bool jumps = at_below != at_above;
      for(int halving = 0; halving < halvings && jumps; ++halving)
      {
        const double middle = 0.5 * (below + above);
        const double at = value(left + middle * (right - left)) - first;
        const double lower = std::abs(at - at_below), upper = std::abs(at_above - at);
        const bool later = upper > lower;
        jumps = std::min(lower, upper) < rest_beside_jump * std::max(lower, upper);
        sum += 0.5 * (above - middle) * (later ? at_below + at : at + at_above);
        (later ? below : above) = middle;
        (later ? at_below : at_above) = at;
      }
      sum += 0.5 * (above - below) * (at_below + at_above);
      left = right;
      at_left = at_right;
    }
    return first + sum / parts;
  }

  /** The same over the first `dimension` coordinates of a cuboid, line by line; the other
   * coordinates are those of `place`. @param value of a Position */
  template <typename Function>
  double mean_over_box(const Function &value, Position place, const Position &from,
                       const Position &to, int dimension, int parts, int halvings)
  {
    if(dimension == 0)
      return value(place);
    const std::size_t last = static_cast<std::size_t>(dimension) - 1;
    return mean_with_jumps(
        [&](double coordinate)
        {
          place[last] = coordinate;
          return mean_over_box(value, place, from, to, dimension - 1, parts, halvings);
        },
        from[last], to[last], parts, halvings);
  }

  /** Where a function jumps, and by how much. */
  struct Jump
  {
    double height = 0; ///< its magnitude
    Position place{};
  };

  /** What is left of the difference of a function between two places where most of it is,
   * on halves of the way from one to the other: of a jump its height, of what is
   * continuous next to nothing. @param value of a Position */
  template <typename Function>
  Jump jump_between(const Function &value, Position from, Position to)
  {
    constexpr int halvings = 48;
    double first = value(from), last = value(to);
    for(int halving = 0; halving < halvings; ++halving)
    {
      Position middle{};
      for(std::size_t d = 0; d < middle.size(); ++d)
        middle[d] = (from[d] + to[d]) / 2;
      const double at = value(middle);
      const bool later = std::abs(last - at) > std::abs(at - first);
      (later ? from : to) = middle;
      (later ? first : last) = at;
    }
    return {std::abs(last - first), to};
  }
} // namespace meltfront::cases

#endif
