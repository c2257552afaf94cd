#ifndef meltfront_particles_rkpm_tracked_line_run_h
#define meltfront_particles_rkpm_tracked_line_run_h

#include <cases/run.h>

namespace meltfront::particles::rkpm_tracked
{
  /** A run of a scene that depends on one coordinate.
   * @throws cases::Refusal for a scene that is not treated. */
  std::unique_ptr<cases::Run> make_line_run(const cases::Scene &scene,
                                            const cases::EffectSet &effects,
                                            const cases::Resolution &resolution);
} // namespace meltfront::particles::rkpm_tracked

#endif
