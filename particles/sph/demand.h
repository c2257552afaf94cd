#ifndef meltfront_particles_sph_demand_h
#define meltfront_particles_sph_demand_h

#include <cases/method.h>
#include <cases/scene.h>
#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  /** Memory of a form of SPH, as measured (bytes). */
  struct SphMemory
  {
    double per_particle;
    double per_neighbour; ///< of each particle
  };

  /**
   * What a run of SPH takes: the particles of a lattice with the neighbours that the
   * kernel reaches there, and steps of the length that keeps the maximum principle far
   * from fronts and walls. Steps of a wanted error are not known in advance (0).
   */
  cases::Demand sph_demand(const SphParameters &parameters, const cases::Scene &scene,
                           const SphMemory &memory);
} // namespace meltfront::particles

#endif
