#ifndef meltfront_particles_sph_sph_run_h
#define meltfront_particles_sph_sph_run_h

#include <cases/method.h>
#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  /** Solve a scene with SPH under a policy. See cases::Method::solve. */
  cases::Cost run_sph(const SphPolicy &policy, const cases::Scene &scene,
                      const cases::EffectSet &effects,
                      const cases::Resolution &resolution, cases::Observer &observer);
} // namespace meltfront::particles

#endif
