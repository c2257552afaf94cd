#ifndef meltfront_particles_alloy_mixture_run_h
#define meltfront_particles_alloy_mixture_run_h

#include <cases/method.h>

namespace meltfront::particles
{
  /** Solve a scene with `sph-mixture`. See cases::Method::solve. */
  cases::Cost run_mixture(const cases::Scene &scene, const cases::EffectSet &effects,
                          const cases::Resolution &resolution, cases::Observer &observer);
} // namespace meltfront::particles

#endif
