#ifndef meltfront_particles_greenspan_force_sweep_h
#define meltfront_particles_greenspan_force_sweep_h

#include <particles/greenspan/neighbour_rows.h>
#include <particles/greenspan/pair_force.h>

#include <memory>

namespace meltfront::particles::greenspan
{
  /** Padded arrays, one for each coordinate. */
  using Coordinates = std::array<std::vector<double>, 3>;

  /** Adds up what the neighbours of all particles do to them. */
  class ForceSweep
  {
  public:
    virtual ~ForceSweep() = default;

    /**
     * velocity += time_step * acceleration, with the pair forces of equation (2.7),
     * summed in the order of the rows, and gravity, equation (2.8).
     * @param gravity downward, along the second coordinate
     */
    virtual void kick(const NeighbourRows &rows, const Coordinates &position,
                      Coordinates &velocity, double time_step, double gravity,
                      int threads) const = 0;
  };

  /** The sweep whose exponents are compiled in where there is one, and else any. */
  std::unique_ptr<ForceSweep> make_force_sweep(const PairForce &force, int dimension);
} // namespace meltfront::particles::greenspan

#endif
