#ifndef meltfront_particles_sph_ranks_rank_exchange_h
#define meltfront_particles_sph_ranks_rank_exchange_h

#include <particles/sph/own_particles.h>

#include <cstdint>
#include <memory>
#include <span>

namespace meltfront::particles
{
  /** Number of this process among those that share a run: of MPI, which is started. */
  int rank_among(int ranks);

  /**
   * Exchange between the processes of MPI by Trilinos' Tpetra: an Import brings values
   * from their owners. Made on all of them at the same time.
   * @param ranks all processes of MPI, or 1: this one alone
   * @param own without an exchange
   * @param numbers of the particles at hand, ascending
   */
  std::shared_ptr<RankExchange>
  make_rank_exchange(int ranks, const OwnParticles &own,
                     std::span<const std::uint32_t> numbers);
} // namespace meltfront::particles

#endif
