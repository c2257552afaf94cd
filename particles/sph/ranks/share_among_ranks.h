#ifndef meltfront_particles_sph_ranks_share_among_ranks_h
#define meltfront_particles_sph_ranks_share_among_ranks_h

#include <cases/capabilities.h>
#include <cases/effects.h>
#include <particles/sph/discretisation.h>
#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  /** What sph takes on several ranks. */
  cases::Capabilities capabilities_on_ranks();

  /** About how many bytes all ranks together take more than one process does. */
  double bytes_of_ranks(const SphParameters &parameters, const cases::Scene &scene,
                        int ranks);

  /**
   * Keep of all particles those that this rank computes or needs for that.
   * @throws cases::Refusal of options that are for one process
   */
  void share_among_ranks(Discretisation &discretisation, const SphParameters &parameters,
                         const cases::EffectSet &effects, int ranks);
} // namespace meltfront::particles

#endif
