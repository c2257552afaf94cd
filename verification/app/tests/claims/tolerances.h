#ifndef meltfront_verification_app_tests_claims_tolerances_h
#define meltfront_verification_app_tests_claims_tolerances_h

#include <verification/app/tests/claims/trial.h>

#include <string>

namespace meltfront::verification::claims
{
  /** By how much an end state may differ from the exact one. */
  struct Tolerance
  {
    double sites; ///< root mean square, over the trial's scale
    double solid; ///< of the solid's share of the domain
  };

  /** Resolution and options that suit a method: those of high order need fewer cells, the
   * published SPH shorter steps. */
  void adapt(const std::string &method, const std::string &form, Trial &trial);

  /** Of a method on the trials' grids. */
  Tolerance tolerance_of(const std::string &method, const cases::Scene &scene);
} // namespace meltfront::verification::claims

#endif
