#ifndef meltfront_particles_sph_mixture_mixture_run_h
#define meltfront_particles_sph_mixture_mixture_run_h

#include <cases/run.h>

namespace meltfront::particles
{
  /** A run of `sph-mixture`. */
  std::unique_ptr<cases::Run> make_mixture_run(const cases::Scene &scene,
                                               const cases::EffectSet &effects,
                                               const cases::Resolution &resolution);
} // namespace meltfront::particles

#endif
