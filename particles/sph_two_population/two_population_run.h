#ifndef meltfront_particles_sph_two_population_two_population_run_h
#define meltfront_particles_sph_two_population_two_population_run_h

#include <cases/run.h>
#include <particles/sph_two_population/parameters.h>

namespace meltfront::particles
{
  std::unique_ptr<cases::Run>
  make_two_population_run(const TwoPopulationPolicy &policy, const cases::Scene &scene,
                          const cases::EffectSet &effects,
                          const cases::Resolution &resolution);
} // namespace meltfront::particles

#endif
