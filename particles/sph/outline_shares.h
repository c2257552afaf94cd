#ifndef meltfront_particles_sph_outline_shares_h
#define meltfront_particles_sph_outline_shares_h

#include <particles/sph/discretisation.h>

#include <vector>

namespace meltfront::particles
{
  /** A line from a particle to a ghost that crosses an outline. */
  struct OutlineCrossing
  {
    std::uint32_t particle;
    cases::Position place; ///< where (m)
    double strength;       ///< of the part that it has in the wall's heat (m)
  };

  /** What a particle takes of the heat of a piece of an outline. */
  struct OutlineShare
  {
    std::uint32_t particle;
    cases::Position place; ///< the piece's middle (m)
    double length;         ///< of the outline (m)
    double depth;          ///< of the particle below the piece's tangent (m)
  };

  /**
   * Divide an outline between particles: pieces of half a spacing or less, which end at
   * its corners, are shared by the particles whose lines cross within a spacing along the
   * outline, in proportion to strength and nearness. So the heat of each piece arrives
   * whole, beside corners and where what a wall gives jumps, too.
   */
  std::vector<OutlineShare> share_outline(const Discretisation &discretisation,
                                          const std::vector<OutlineCrossing> &crossings);
} // namespace meltfront::particles

#endif
