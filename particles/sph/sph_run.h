#ifndef meltfront_particles_sph_sph_run_h
#define meltfront_particles_sph_sph_run_h

#include <cases/run.h>
#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  std::unique_ptr<cases::Run> make_sph_run(const SphPolicy &policy,
                                           const cases::Scene &scene,
                                           const cases::EffectSet &effects,
                                           const cases::Resolution &resolution);
} // namespace meltfront::particles

#endif
