#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

namespace meltfront::particles::testing
{
  namespace
  {
    // Values of an independent computation with another integrator.
    TEST(MushySimilarity, HasIndependentConstants)
    {
      MushyLayer layer = nitrate_layer();
      EXPECT_NEAR(MushySimilarity(layer).lambda(), 0.472731880944, 1e-9);
      layer.constant_heat = true;
      EXPECT_NEAR(MushySimilarity(layer).lambda(), 0.467177889003, 1e-9);
      layer.expansion = 1;
      EXPECT_NEAR(MushySimilarity(layer).lambda(), 0.437252447737, 1e-9);
      layer.constant_heat = false;
      EXPECT_NEAR(MushySimilarity(layer).lambda(), 0.442347427826, 1e-9);
    }

    TEST(MushySimilarity, HasIndependentProfiles)
    {
      const MushySimilarity early(nitrate_layer());
      EXPECT_NEAR(early.temperature(0.01, 13200), -13.9501373, 1e-6);
      EXPECT_NEAR(early.temperature(0.03, 13200), -8.1325002, 1e-6);
      EXPECT_NEAR(early.temperature(0.05, 13200), 0.3579717, 1e-6);
      EXPECT_NEAR(early.temperature(0.08, 91800), -8.0194987, 1e-6);
      EXPECT_NEAR(early.temperature(0.20, 91800), 8.2876093, 1e-6);
      EXPECT_NEAR(early.front(91800), 0.094403793, 1e-8);
    }

    struct Level
    {
      int n;
      double temperature, ice; ///< root mean square (K); relative
    };

    // Measured: 0.0300, 0.0168, 0.0030, 0.0011 K.
    TEST(Mixture, ConvergesToTheMushyLayer)
    {
      const double time = 91800;
      std::vector<double> spacing, errors;
      for(const Level &level : {Level{30, 0.045, 0.012}, Level{60, 0.025, 0.004},
                                Level{120, 0.0045, 0.001}, Level{240, 0.0017, 0.0003}})
      {
        const auto outcome = run(*make_sph_mixture(), nitrate_slab(time), level.n);
        const MushErrors found = compare(outcome, nitrate_layer(), time);
        EXPECT_LT(found.temperature, level.temperature) << level.n;
        EXPECT_LT(std::abs(found.ice), level.ice) << level.n;
        EXPECT_LT(outcome.heat_defect, 1e-12);
        EXPECT_LT(outcome.solute_defect, 1e-12);
        spacing.push_back(outcome.description.spacing);
        errors.push_back(found.temperature);
      }
      EXPECT_GT(fitted_order(spacing, errors), 1.5);
    }
  } // namespace
} // namespace meltfront::particles::testing
