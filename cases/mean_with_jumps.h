#ifndef meltfront_cases_mean_with_jumps_h
#define meltfront_cases_mean_with_jumps_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace meltfront::cases
{
  /**
   * The mean of a function that may jump, between two points: by the trapezoidal rule,
   * where values beside each other differ on ever finer parts about the larger
   * difference. Of a jump it misses no more than (to - from) / parts / 2^halvings;
   * a feature that is narrower than a part may go unseen.
   */
  template <typename Function>
  double mean_with_jumps(const Function &value, double from, double to, int parts,
                         int halvings)
  {
    constexpr double no_jump = 1e-3; // of the larger value
    double left = from, at_left = value(from), sum = 0;
    const double first = at_left;
    for(int part = 1; part <= parts; ++part)
    {
      const double right = part == parts ? to : from + part * (to - from) / parts;
      const double at_right = value(right);
      double below = 0, above = 1, at_below = at_left - first,
             at_above = at_right - first;
      const double jump = no_jump * std::max(std::abs(at_left), std::abs(at_right));
      for(int halving = 0; halving < halvings && std::abs(at_above - at_below) > jump;
          ++halving)
      {
        const double middle = 0.5 * (below + above);
        const double at = value(left + middle * (right - left)) - first;
        const bool later = std::abs(at_above - at) > std::abs(at - at_below);
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

  /** The same over a rectangle or a cuboid, line by line.
   * @param value of N coordinates, a std::array<double, N> */
  template <std::size_t N, typename Function>
  double mean_over_box(const Function &value, const std::array<double, N> &from,
                       const std::array<double, N> &to, int parts, int halvings)
  {
    return mean_with_jumps(
        [&](double last)
        {
          if constexpr(N == 1)
            return value(std::array<double, 1>{last});
          else
          {
            std::array<double, N - 1> lower, upper;
            std::copy_n(from.begin(), N - 1, lower.begin());
            std::copy_n(to.begin(), N - 1, upper.begin());
            return mean_over_box<N - 1>(
                [&](const std::array<double, N - 1> &others)
                {
                  std::array<double, N> at;
                  std::copy_n(others.begin(), N - 1, at.begin());
                  at[N - 1] = last;
                  return value(at);
                },
                lower, upper, parts, halvings);
          }
        },
        from[N - 1], to[N - 1], parts, halvings);
  }
} // namespace meltfront::cases

#endif
