#ifndef meltfront_particles_rkpm_tracked_plane_spline_h
#define meltfront_particles_rkpm_tracked_plane_spline_h

#include <particles/rkpm_tracked/plane/bins.h>

#include <span>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /**
   * Cubic spline through values on a closed curve, C2 everywhere, over the length of the
   * polygon through the curve's points (de Boor 1978, chapter IV).
   *
   * `Value` is a number or a vector of Eigen.
   */
  template <typename Value>
  class PeriodicSpline
  {
  public:
    /** @param knots ascending lengths of the points, at the end that of the whole round
     * @param values one less than knots, at least three */
    PeriodicSpline(std::span<const double> knots, std::span<const Value> values)
      : knots(knots.begin(), knots.end())
      , values(values.begin(), values.end())
    {
      this->values.push_back(values.front());
      find_second_derivatives();
    }

    double length() const
    {
      return knots.back() - knots.front();
    }

    Value value(std::size_t piece, double share) const
    {
      const double h = knots[piece + 1] - knots[piece], b = share, a = 1 - share;
      return a * values[piece] + b * values[piece + 1]
             + h * h / 6
                   * ((a * a * a - a) * second[piece]
                      + (b * b * b - b) * second[piece + 1]);
    }

    /** First derivative with respect to the length. */
    Value slope(std::size_t piece, double share) const
    {
      const double h = knots[piece + 1] - knots[piece], b = share, a = 1 - share;
      return (values[piece + 1] - values[piece]) / h
             + h / 6
                   * ((3 * b * b - 1) * second[piece + 1]
                      - (3 * a * a - 1) * second[piece]);
    }

    /** Second derivative at a knot. */
    const Value &bend(std::size_t knot) const
    {
      return second[knot];
    }

  private:
    /** Continuity of the slopes: a cyclic tridiagonal system, solved as a tridiagonal one
     * and a correction of rank one. */
    void find_second_derivatives()
    {
      const std::size_t n = values.size() - 1;
      const auto width = [&](std::size_t i) { return knots[i % n + 1] - knots[i % n]; };
      std::vector<double> diagonal(n), above(n), corner(n, 0.);
      std::vector<Value> right(n);
      for(std::size_t i = 0; i < n; ++i)
      {
        const double before = width(i + n - 1), after = width(i);
        diagonal[i] = (before + after) / 3;
        above[i] = after / 6;
        right[i] = (values[i + 1] - values[i]) / after
                   - (values[i] - values[(i + n - 1) % n]) / before;
      }
      // The corners are gamma u v^T with u = (1, 0, ..., c/gamma), v = (1, ..., c/gamma).
      const double link = above[n - 1], gamma = -diagonal[0];
      diagonal[0] -= gamma;
      diagonal[n - 1] -= link * link / gamma;
      corner[0] = gamma;
      corner[n - 1] = link;
      for(std::size_t i = 1; i < n; ++i)
      {
        const double factor = above[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * above[i - 1];
        right[i] = right[i] - factor * right[i - 1];
        corner[i] -= factor * corner[i - 1];
      }
      right[n - 1] = right[n - 1] / diagonal[n - 1];
      corner[n - 1] /= diagonal[n - 1];
      for(std::size_t i = n - 1; i-- > 0;)
      {
        right[i] = (right[i] - above[i] * right[i + 1]) / diagonal[i];
        corner[i] = (corner[i] - above[i] * corner[i + 1]) / diagonal[i];
      }
      const double share = link / gamma;
      const Value along
          = (right[0] + share * right[n - 1]) / (1 + corner[0] + share * corner[n - 1]);
      for(std::size_t i = 0; i < n; ++i)
        right[i] = right[i] - corner[i] * along;
      second = std::move(right);
      second.push_back(second.front());
    }

    std::vector<double> knots;
    std::vector<Value> values, second;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
