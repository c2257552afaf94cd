#ifndef meltfront_verification_app_tests_claims_mushes_h
#define meltfront_verification_app_tests_claims_mushes_h

#include <verification/app/tests/claims/trial.h>

#include <optional>

namespace meltfront::verification::claims
{
  /**
   * Of an effect of alloys: mushy layers that grow from a cold wall.
   * @param published whether liquid and ice exchange heat as Monaghan, Huppert and
   * Worster (2005) printed it: what such a method repeats is the layer that conducts so
   * and has a constant heat of freezing
   */
  std::optional<EffectTrials> mush_trials(cases::Effect effect, bool published);
} // namespace meltfront::verification::claims

#endif
