#ifndef meltfront_verification_app_tests_claims_turned_h
#define meltfront_verification_app_tests_claims_turned_h

#include <verification/app/tests/claims/trial.h>

namespace meltfront::verification::claims
{
  /** The trial of a disk or an annulus, of what is round, on a body about an axis: a can
   * with insulated lids in which nothing varies along the axis. */
  Trial turned(Trial round);

  /** The trial of a slab on a can in which nothing varies but along the axis. */
  Trial upright(Trial slab);

  EffectTrials turned(const EffectTrials &round);
  EffectTrials upright(const EffectTrials &slab);
} // namespace meltfront::verification::claims

#endif
