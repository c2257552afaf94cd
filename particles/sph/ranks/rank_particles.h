#ifndef meltfront_particles_sph_ranks_rank_particles_h
#define meltfront_particles_sph_ranks_rank_particles_h

#include <particles/sph/discretisation.h>

#include <cstdint>
#include <vector>

namespace meltfront::particles
{
  /** How far around a rank's own particles on a lattice it holds those of others, in
   * cells along each direction. */
  struct HaloDepth
  {
    int values = 1; ///< as far as what they compute depends on others' values
    /** As far as it matters which slices of the operator reach a front: also what the
     * slices there reach is held. */
    int fronts = 0;
  };

  /** Of the particles of a run those that a rank holds. */
  struct RankParticles
  {
    std::vector<std::uint32_t> numbers; ///< ascending
    OwnParticles own;                   ///< without an exchange
  };

  /**
   * A rank's share of particles on a lattice: as many as each other's along the curve
   * that orders them, in whole slices of the operator, and whole slices of others around
   * them. So its slices are those of one process, and every sum over a row or a slice has
   * the same terms in the same order.
   *
   * @param whole all particles
   * @throws cases::Refusal for fewer slices than ranks
   */
  RankParticles particles_of_rank(const Discretisation &whole, const HaloDepth &depth,
                                  int rank, int ranks);
} // namespace meltfront::particles

#endif
