#include <cases/error.h>
#include <cases/exact/mushy_layer.h>
#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph/tests/scenes.h>
#include <particles/sph_two_population/phase_exchange.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::testing
{
  namespace
  {
    struct Drop
    {
      double concentration, heat, drop, fraction;
    };

    // Values of an independent computation.
    TEST(Freezing, MakesTheIceThatTheHeatAllows)
    {
      for(const Drop &expected : {Drop{0.14, 100, 0.00164859299451, 0.000278438634027},
                                  Drop{0.14, 1e4, 0.169370662024, 0.0278178034592},
                                  Drop{0.14, 1e5, 2.2451318113, 0.274992719943},
                                  Drop{0.14, 3e5, 18.4630487574, 0.75723322082},
                                  Drop{0.30, 1e4, 0.335473834385, 0.0257670808093},
                                  Drop{0.30, 1e5, 4.28492269945, 0.252515894812}})
      {
        const Freezing<double> found
            = freeze(expected.heat, 42.28 * expected.concentration, 334400., 2006, 4180);
        EXPECT_NEAR(found.drop / expected.drop, 1, 1e-11) << expected.heat;
        EXPECT_NEAR(found.fraction / expected.fraction, 1, 1e-11) << expected.heat;
      }
    }

    // From almost none to more than all the latent heat.
    TEST(Freezing, LosesTheHeatThatIsTaken)
    {
      for(const double heat : {1e-9, 1., 1e3, 3e5, 3.6e5, 1e6})
      {
        const double lowered = 3.;
        const Freezing<double> f = freeze(heat, lowered, 334400., 2006, 4180);
        EXPECT_NEAR(
            (f.fraction * (334400 + 2006 * f.drop) + (1 - f.fraction) * 4180 * f.drop)
                / heat,
            1, 1e-12);
        EXPECT_LT(f.fraction, 1);
      }
    }

    struct Level
    {
      int n;
      double temperature, theta, ice;
    };

    TEST(TwoPopulation, ConvergesToTheMushyLayer)
    {
      const double time = 91800;
      std::vector<double> spacing, errors;
      for(const Level &level :
          {Level{30, 0.1, 0.011, 0.026}, Level{45, 0.06, 0.006, 0.012},
           Level{60, 0.04, 0.004, 0.006}, Level{120, 0.011, 0.001, 0.002}})
      {
        const auto outcome = run(*make_sph_two_population(), nitrate_slab(time), level.n);
        const MushErrors found = compare(outcome, nitrate_layer(), time);
        EXPECT_LT(found.temperature, level.temperature) << level.n;
        EXPECT_LT(found.theta, level.theta) << level.n;
        EXPECT_LT(std::abs(found.ice), level.ice) << level.n;
        EXPECT_LT(outcome.heat_defect, 1e-12);
        EXPECT_LT(outcome.mass_defect, 1e-12);
        EXPECT_LT(outcome.solute_defect, 1e-12);
        spacing.push_back(outcome.description.spacing);
        errors.push_back(found.temperature);
      }
      EXPECT_GT(fitted_order(spacing, errors), 1.2);
    }

    TEST(TwoPopulation, IsCloseAfterFourHours)
    {
      const double time = 13200;
      const auto outcome = run(*make_sph_two_population(), nitrate_slab(time), 60);
      const MushErrors found = compare(outcome, nitrate_layer(), time);
      EXPECT_LT(found.temperature, 0.12);
      EXPECT_LT(std::abs(found.ice), 0.03);
    }

    /** The brine on a wall below its eutectic temperature. */
    Problem eutectic_slab()
    {
      cases::Scene scene = nitrate_slab(91800);
      scene.alloy->eutectic_temperature = -17.7;
      const auto exact = std::make_shared<cases::MushyLayer>(
          scene.material, *scene.alloy, std::vector<double>{nitrate_concentration}, -30,
          14.7);
      scene.boundaries[0] = fixed_wall(-30);
      scene.boundaries[1] = exact_wall(exact);
      return {scene, exact};
    }

    // A front of first crystals and one behind which no liquid is left.
    TEST(TwoPopulation, ConvergesToTheLayerWithAEutectic)
    {
      const auto [scene, exact] = eutectic_slab();
      std::vector<double> spacing, errors;
      for(const int n : {30, 45, 60, 120})
      {
        const auto found = run(*make_sph_two_population(), scene, n);
        double sum = 0, solid = 0;
        for(std::size_t i = 0; i < found.x.size(); ++i)
        {
          const double deviation
              = found.temperature[i]
                - exact->temperature(cases::Position{found.x[i], 0, 0}, scene.end_time);
          sum += deviation * deviation;
        }
        constexpr int samples = 20000;
        for(int i = 0; i < samples; ++i)
          solid += exact->solid_fraction(0.5 * (i + 0.5) / samples, scene.end_time) * 0.5
                   / samples;
        errors.push_back(std::sqrt(sum / found.x.size()));
        spacing.push_back(found.description.spacing);
        EXPECT_NEAR(found.solid / solid, 1, 1. / n) << n;
        EXPECT_LT(found.heat_defect, 1e-12);
        EXPECT_LT(found.mass_defect, 1e-12);
        EXPECT_LT(found.solute_defect, 1e-12);
        EXPECT_GE(found.lowest, -30);
        EXPECT_LE(found.highest, 14.7 + 1e-9);
        EXPECT_EQ(found.solid_fraction[0], 1) << n;
      }
      EXPECT_LT(errors.back(), 0.045);
      EXPECT_GT(fitted_order(spacing, errors), 1.2);
    }

    // What froze at the eutectic temperature gives its solute back.
    TEST(TwoPopulation, FreezesThroughTheEutecticAndMeltsBack)
    {
      cases::Scene scene = eutectic_slab().scene;
      scene.end_time = 2e6;
      scene.boundaries[0]->value = {
          "", [](const cases::Position &, double t) { return t < 20000 ? -30. : 14.7; },
          false};
      scene.boundaries[1] = cases::Boundary{};
      for(const double diffusivity : {0., 6.2e-10})
      {
        scene.alloy->solutes[0].diffusivity = diffusivity;
        const auto found = run(*make_sph_two_population(), scene, 20);
        EXPECT_GT(*std::max_element(found.solids.begin(), found.solids.end()), 0.04);
        EXPECT_EQ(found.solid, 0);
        EXPECT_LT(found.heat_defect, 1e-12);
        EXPECT_LT(found.mass_defect, 1e-12);
        EXPECT_LT(found.solute_defect, 1e-12);
        EXPECT_GT(found.lowest, -30);
        EXPECT_LE(found.highest, 14.7 + 1e-9);
        for(const double c : found.concentration[0])
          EXPECT_NEAR(c, nitrate_concentration, diffusivity > 0 ? 0.1 : 1e-14);
        cases::Scene frozen = scene;
        frozen.end_time = 20000;
        EXPECT_EQ(run(*make_sph_two_population(), frozen, 20).solid_fraction[0], 1);
      }
    }

    // What the corrections are for: with the published exchange finer particles do not
    // help, and too much ice grows.
    TEST(TwoPopulation2005, DoesNotConverge)
    {
      const double time = 91800;
      std::vector<double> ice;
      for(const int n : {30, 60})
      {
        const auto outcome = run(*make_sph_two_population_2005(), nitrate_slab(time), n,
                                 {{"step_factor", "0.075"}});
        const MushErrors found = compare(outcome, nitrate_layer(), time);
        EXPECT_GT(found.temperature, 1.5) << n;
        ice.push_back(found.ice);
        // A constant latent heat is no function of the state: heat seems to vanish.
        EXPECT_GT(outcome.heat_defect, 1e-3);
        EXPECT_LT(outcome.mass_defect, 1e-12);
        EXPECT_LT(outcome.solute_defect, 1e-12);
      }
      EXPECT_GT(ice[1], ice[0]);
      EXPECT_GT(ice[1], 0.1);
    }

    // Steps of 0.15 c rho h^2/k are too long for ice of little mass.
    TEST(TwoPopulation2005, BlowsUpWithThePublishedStep)
    {
      try
      {
        run(*make_sph_two_population_2005(), nitrate_slab(91800), 60,
            {{"step_limit", "printed"}});
        FAIL() << "no blow-up";
      }
      catch(const cases::NumericalError &error)
      {
        EXPECT_EQ(error.method, "sph-two-population-2005");
        EXPECT_GT(error.step, 1000);
        EXPECT_GT(error.time, 10000);
        EXPECT_LT(error.time, 91800);
        EXPECT_NE(error.quantity.find("ice particle"), std::string::npos);
      }
    }
  } // namespace
} // namespace meltfront::particles::testing
