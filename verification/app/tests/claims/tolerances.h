#ifndef meltfront_verification_app_tests_claims_tolerances_h
#define meltfront_verification_app_tests_claims_tolerances_h

#include <cases/scene.h>

#include <string>

namespace meltfront::verification::claims
{
  /** By how much an end state may differ from the exact one. */
  struct Tolerance
  {
    double sites; ///< root mean square, over the trial's scale
    double solid; ///< of the solid's share of the domain
  };

  /** Of a method on the trials' grids. */
  Tolerance tolerance_of(const std::string &method, const cases::Scene &scene);
} // namespace meltfront::verification::claims

#endif
