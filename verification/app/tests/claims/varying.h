#ifndef meltfront_verification_app_tests_claims_varying_h
#define meltfront_verification_app_tests_claims_varying_h

#include <verification/app/tests/claims/trial.h>

#include <optional>

namespace meltfront::verification::claims
{
  /**
   * Slabs of materials whose properties depend on temperature, or that melt over a range,
   * and a plane that gives off heat and moves:
   *
   *   conductivity    between two temperatures, steady: Kirchhoff's variable is linear
   *   heat capacity,  two halves come to the temperature that has their mean enthalpy
   *   melting range
   *   moving source   cosines between insulated walls
   */
  std::optional<EffectTrials> varying_trials(cases::Effect effect);
} // namespace meltfront::verification::claims

#endif
