#ifndef meltfront_particles_greenspan_motion_force_sweep_h
#define meltfront_particles_greenspan_motion_force_sweep_h

#include <particles/greenspan/motion/neighbour_rows.h>
#include <particles/greenspan/motion/pair_force.h>

#include <memory>

namespace meltfront::particles::greenspan
{
  /** Padded arrays, one for each coordinate. */
  using Coordinates = std::array<std::vector<double>, 3>;

  /** What a sweep does beside the pair forces. */
  struct KickSize
  {
    double time_step;
    double gravity; ///< downward, along the second coordinate
    double left;    ///< share of the velocity that drag leaves; 1: no drag
  };

  /** Adds up what the neighbours of all particles do to them. */
  class ForceSweep
  {
  public:
    virtual ~ForceSweep() = default;

    /**
     * velocity = left * (velocity + time_step * acceleration), with the pair forces of
     * equation (2.7), summed in the order of the rows, and gravity, equation (2.8).
     */
    virtual void kick(const NeighbourRows &rows, const Coordinates &position,
                      Coordinates &velocity, const KickSize &size, int threads) const = 0;
  };

  /** The sweep whose exponents are compiled in where there is one, and else any; where
   * space does not repeat itself nothing looks for nearest images. */
  std::unique_ptr<ForceSweep> make_force_sweep(const PairForce &force, int dimension,
                                               const Period &period = {});
} // namespace meltfront::particles::greenspan

#endif
