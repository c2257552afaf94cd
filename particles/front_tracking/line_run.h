#ifndef meltfront_particles_front_tracking_line_run_h
#define meltfront_particles_front_tracking_line_run_h

#include <cases/method.h>

namespace meltfront::particles::front_tracking
{
  /**
   * Solve a scene that depends on one coordinate.
   * @throws cases::Refusal for a scene that is not treated, cases::NumericalError where a
   * step fails.
   */
  cases::Cost solve_line(const cases::Scene &scene, const cases::EffectSet &effects,
                         const cases::Resolution &resolution, cases::Observer &observer);
} // namespace meltfront::particles::front_tracking

#endif
