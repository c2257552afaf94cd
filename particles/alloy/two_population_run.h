#ifndef meltfront_particles_alloy_two_population_run_h
#define meltfront_particles_alloy_two_population_run_h

#include <cases/method.h>
#include <particles/alloy/parameters.h>

namespace meltfront::particles
{
  /** Solve a scene with particles of two populations under a policy. See
   * cases::Method::solve. */
  cases::Cost run_two_population(const TwoPopulationPolicy &policy,
                                 const cases::Scene &scene,
                                 const cases::EffectSet &effects,
                                 const cases::Resolution &resolution,
                                 cases::Observer &observer);
} // namespace meltfront::particles

#endif
