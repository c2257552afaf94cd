#ifndef meltfront_particles_sph_sph_run_h
#define meltfront_particles_sph_sph_run_h

#include <cases/shared_run.h>
#include <particles/sph/parameters.h>

namespace meltfront::particles
{
  std::unique_ptr<cases::Run> make_sph_run(const SphPolicy &policy,
                                           const cases::Scene &scene,
                                           const cases::EffectSet &effects,
                                           const cases::Resolution &resolution);

  /** The same run, shared by so many processes of MPI. */
  std::unique_ptr<cases::SharedRun>
  make_shared_sph_run(const SphPolicy &policy, const cases::Scene &scene,
                      const cases::EffectSet &effects,
                      const cases::Resolution &resolution, int ranks);
} // namespace meltfront::particles

#endif
