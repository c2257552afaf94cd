#ifndef meltfront_particles_level_set_weno_h
#define meltfront_particles_level_set_weno_h

#include <algorithm>
#include <cstddef>

namespace meltfront::particles::level_set
{
  /**
   * One-sided derivative of fifth order where phi is smooth, from five differences of
   * neighbouring nodes in upwind order, times the spacing: three candidates of third
   * order, weighted by how smooth phi is along each (Jiang and Peng 2000, equations 2.4
   * to 2.9).
   *
   * The weights 0.1/(e + S_1)^2, 0.6/(e + S_2)^2, 0.3/(e + S_3)^2 are multiplied by all
   * three denominators: one division instead of four.
   */
  inline double weno5(double v1, double v2, double v3, double v4, double v5)
  {
    const auto square = [](double x) { return x * x; };
    const double largest = std::max(
        std::max(std::max(square(v1), square(v2)), std::max(square(v3), square(v4))),
        square(v5));
    // the square of what is added must not underflow
    const double e = 1e-6 * largest + 1e-60;
    constexpr double c = 13. / 12;
    const double s1 = e + c * square(v1 - 2 * v2 + v3) + square(v1 - 4 * v2 + 3 * v3) / 4;
    const double s2 = e + c * square(v2 - 2 * v3 + v4) + square(v2 - v4) / 4;
    const double s3 = e + c * square(v3 - 2 * v4 + v5) + square(3 * v3 - 4 * v4 + v5) / 4;
    const double a1 = 0.1 * square(s2 * s3);
    const double a2 = 0.6 * square(s1 * s3);
    const double a3 = 0.3 * square(s1 * s2);
    const double sum = a1 * (2 * v1 - 7 * v2 + 11 * v3) + a2 * (-v2 + 5 * v3 + 2 * v4)
                       + a3 * (2 * v3 + 5 * v4 - v5);
    return sum / (6 * (a1 + a2 + a3));
  }

  /** The differences about a node along one coordinate, `step` apart in memory. */
  struct Differences
  {
    double a, b, c, d, e, f; ///< from phi(i - 2) - phi(i - 3) to phi(i + 3) - phi(i + 2)

    Differences(const double *phi, std::ptrdiff_t step)
      : a(phi[-2 * step] - phi[-3 * step])
      , b(phi[-step] - phi[-2 * step])
      , c(phi[0] - phi[-step])
      , d(phi[step] - phi[0])
      , e(phi[2 * step] - phi[step])
      , f(phi[3 * step] - phi[2 * step])
    {
    }

    /** Derivative from below, times the spacing. */
    double from_below() const
    {
      return weno5(a, b, c, d, e);
    }

    /** Derivative from above, times the spacing. */
    double from_above() const
    {
      return weno5(f, e, d, c, b);
    }

    /** One of the two, without a branch. */
    double from(bool below) const
    {
      return weno5(below ? a : f, below ? b : e, below ? c : d, below ? d : c,
                   below ? e : b);
    }
  };
} // namespace meltfront::particles::level_set

#endif
