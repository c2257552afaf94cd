#ifndef meltfront_verification_app_tests_claims_conduction_h
#define meltfront_verification_app_tests_claims_conduction_h

#include <verification/app/tests/claims/trial.h>

#include <optional>

namespace meltfront::verification::claims
{
  /**
   * A wave of heat that decays in a domain without a front, exact, with walls of a kind:
   * those at both ends of x of a slab or a box (the others hold the exact temperature, or
   * are insulated where `held` is false), all of the other shapes. Where a round domain
   * is insulated the wave is round.
   */
  Trial heat_wave(cases::DomainShape shape, int dimension, cases::BoundaryKind kind,
                  bool held);

  /** The same of an alloy so warm that nothing crystallises. */
  Trial dissolved(Trial trial);

  /** Of an effect of conduction without a front: a steady slab with linear or quadratic
   * temperatures. */
  std::optional<EffectTrials> steady_trials(cases::Effect effect);

  /** A slab whose half conducts otherwise, which has become steady. */
  EffectTrials inclusion_trials();
} // namespace meltfront::verification::claims

#endif
