#ifndef meltfront_verification_app_tests_claims_motion_h
#define meltfront_verification_app_tests_claims_motion_h

#include <verification/app/tests/claims/trial.h>

#include <optional>

namespace meltfront::verification::claims
{
  /** A disk or ball that a uniform velocity carries along, between walls of a kind at
   * both ends of x. */
  Trial advected_ball(int dimension, cases::BoundaryKind kind);

  /** Particles that hardly bind each other, so that each goes its own way, which is
   * known. */
  std::optional<EffectTrials> free_particle_trials(cases::Effect effect);

  /** A bar of particles that melts from its hot end as Neumann's solution does of the
   * material that it is measured to be. */
  Trial particle_bar(double hot);

  /** The same with another hot end or another material. */
  std::optional<EffectTrials> particle_bar_trials(cases::Effect effect);
} // namespace meltfront::verification::claims

#endif
