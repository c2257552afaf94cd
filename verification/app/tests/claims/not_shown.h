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
    const std::string published = "the published form breaks the maximum principle in "
                                  "this mush and is stopped",
                      noise = "a bar of 74 x 8 particles is noisier than the tolerance",
                      coarse = "off by 1.1 to 2 tolerances at this resolution";
    return std::map<std::string, std::string>{
        {"EffectClaims.SphTwoPopulation2005_PhaseChange", published},
        {"EffectClaims.SphTwoPopulation2005_PhaseConductivity", published},
        {"EffectClaims.SphTwoPopulation2005_PhaseHeatCapacity", published},
        {"EffectClaims.SphTwoPopulation2005_WallTemperature", published},
        {"EffectClaims.SphTwoPopulation2005_Solute", published},
        {"EffectClaims.SphTwoPopulation2005_SoluteDiffusion", published},
        {"EffectClaims.RkpmTrackedInThePlane_GibbsThomson",
         "the solid's share is off by 0.013 at n = 18, tolerance 0.01"},
        {"EffectClaims.GreenspanAsABarThatConductsHeat_WallTemperature", noise},
        {"FrontOriginClaims.GreenspanAsABarThatConductsHeat_Wall", noise},
        {"WallClaims.GreenspanAsABarThatConductsHeat_Slab1DFixedTemperature", noise},
        {"EffectClaims.FemCut_HeatSources",
         "the front of the sink cannot be seeded at this resolution"},
        {"WallClaims.SphMixture_Ball3DFlux", coarse},
        {"WallClaims.FemFittedInMoreDimensions_Shell3DFlux", coarse},
        {"WallClaims.FemFittedInMoreDimensions_Shell3DHeatTransfer", coarse},
        {"WallClaims.FemCut_Shell2DInsulated", coarse},
        {"WallClaims.FemCut_Shell2DFixedTemperature", coarse},
        {"WallClaims.FemCut_Shell2DFlux", coarse},
        {"WallClaims.FemFittedAlongALine_Shell3DFlux", coarse},
        {"WallClaims.FemFittedAlongALine_Shell3DHeatTransfer", coarse},
        {"WallClaims.RkpmTrackedAlongALine_Ball3DFlux", coarse},
        {"WallClaims.RkpmTrackedAlongALine_Ball3DHeatTransfer", coarse},
        {"WallClaims.RkpmTrackedAlongALine_Shell3DFlux", coarse},
        {"WallClaims.RkpmTrackedAlongALine_Shell3DHeatTransfer", coarse}};
  }();
} // namespace meltfront::verification::claims

#endif
