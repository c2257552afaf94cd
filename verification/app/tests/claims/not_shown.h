#ifndef meltfront_verification_app_tests_claims_not_shown_h
#define meltfront_verification_app_tests_claims_not_shown_h

#include <map>
#include <string>

namespace meltfront::verification::claims
{
  /** Claims whose test does not pass yet, by the test's name, with what was seen. They
   * are skipped, and stay here until they pass or the claim goes. */
  inline const std::map<std::string, std::string> not_shown = []
  {
    // Not noise: an average over seeds or a larger change of the wall would not do.
    const std::string bar
        = "a bar of 74 x 8 particles has melted to 0.215 +- 0.011 (six seeds), where "
          "Neumann's solution has 0.280, and at a wall of 46 not at all (0.044)";
    return std::map<std::string, std::string>{
        {"EffectClaims.GreenspanAsABarThatConductsHeat_WallTemperature", bar},
        {"FrontOriginClaims.GreenspanAsABarThatConductsHeat_Wall", bar},
        {"WallClaims.GreenspanAsABarThatConductsHeat_Slab1DFixedTemperature", bar}};
  }();
} // namespace meltfront::verification::claims

#endif
