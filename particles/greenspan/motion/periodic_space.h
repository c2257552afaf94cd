#ifndef meltfront_particles_greenspan_motion_periodic_space_h
#define meltfront_particles_greenspan_motion_periodic_space_h

#include <particles/greenspan/motion/sparse_cells.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  /** Up to here looking at all pairs is faster than setting cells up. */
  inline constexpr std::size_t few_particles = 200;

  /** Lengths after which space repeats itself in each direction; 0: it does not. */
  using Period = std::array<double, 3>;

  /** Whether space repeats itself in some direction. */
  inline bool repeats(const Period &period)
  {
    return period[0] > 0 || period[1] > 0 || period[2] > 0;
  }

  /**
   * The way from one particle to the nearest image of another, in one direction. Odd in
   * the difference to the last bit, so that both particles of a pair see the same.
   * Coordinates are not wrapped: what has gone round keeps count of it.
   */
  class NearestImage
  {
  public:
    explicit NearestImage(double period)
      : period(period)
      , inverse(period > 0 ? (1 + 0x1p-40) / period : 0)
    {
    }

    double operator()(double difference) const
    {
      return difference - period * std::rint(difference * inverse);
    }

  private:
    /** The inverse is a little too large: what a lone particle is away by remains larger
     * than any solid, and nobody else goes round that often. */
    double period, inverse;
  };

  /** A coordinate in [0, period); as it is where space does not repeat itself. */
  double wrapped(double coordinate, double period);

  /**
   * The particles nearer to each than a radius where space repeats itself, in no
   * particular order. A row's particle stands for its nearest image.
   * @param position of which the first n are looked at, 2 or 3 coordinates
   * @param among_all look at all pairs instead of cells
   */
  FoundRows find_in_periodic_space(int dimension,
                                   const std::array<std::vector<double>, 3> &position,
                                   std::size_t n, double radius, const Period &period,
                                   bool among_all);
} // namespace meltfront::particles::greenspan

#endif
