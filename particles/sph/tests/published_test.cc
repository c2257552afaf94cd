#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>

// The form of the method as Monaghan, Huppert and Worster (2005) computed.
namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph_2005();

    TEST(Published, TableOneOfThePaper)
    {
      const std::vector<int> levels{20, 30, 40, 50};
      const double error_1[] = {0.01063, 0.00544, 0.00370, 0.00275};
      const double error_2[] = {0.0167, 0.00840, 0.00548, 0.00407};
      const long steps[] = {713, 1659, 3000, 4736};
      std::vector<double> spacing, first, second;
      for(std::size_t i = 0; i < levels.size(); ++i)
      {
        const Outcome outcome = run(*method, line_sink(), levels[i]);
        EXPECT_NEAR(outcome.ice_radius_rms, error_1[i], 0.15 * error_1[i]) << levels[i];
        EXPECT_NEAR(outcome.heat_loss_rms, error_2[i], 0.15 * error_2[i]) << levels[i];
        EXPECT_EQ(outcome.cost.steps, steps[i]);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        spacing.push_back(outcome.description.spacing);
        first.push_back(outcome.ice_radius_rms);
        second.push_back(outcome.heat_loss_rms);
      }
      EXPECT_GE(fitted_order(spacing, first), 1.35);
      EXPECT_LE(fitted_order(spacing, first), 1.75);
      EXPECT_GE(fitted_order(spacing, second), 1.35);
      EXPECT_LE(fitted_order(spacing, second), 1.75);
    }

    // Front by latent heat, as an independent code of the same scheme found it.
    TEST(Published, FrontByLatentHeatOfTheLineSink)
    {
      const double expected[] = {0.00442, 0.00335, 0.00267};
      const int levels[] = {30, 40, 50};
      for(int i = 0; i < 3; ++i)
        EXPECT_NEAR(run(*method, line_sink(), levels[i]).front_rms, expected[i],
                    0.03 * expected[i]);
    }

    TEST(Published, PlaneFreezingWithFortyParticles)
    {
      Problem problem = plane_freezing();
      problem.scene.boundaries[1] = fixed_wall(1.2);
      const Outcome outcome = run(*method, problem, 40);
      EXPECT_EQ(outcome.cost.steps, 400);
      EXPECT_EQ(outcome.position_x.size(), 1600u);
      EXPECT_LE(outcome.largest_defect, 1e-12);
      double length = 0;
      int partly_frozen = 0;
      for(std::size_t i = 0; i < outcome.position_x.size(); ++i)
      {
        length += outcome.weights[i];
        const double row = outcome.position_x[i] * 39;
        const double fraction = outcome.solid_fraction[i];
        if(fraction > 0 && fraction < 1)
        {
          ++partly_frozen;
          EXPECT_NEAR(fraction, 0.661, 0.005);
          EXPECT_NEAR(row, 9, 1e-9);
        }
        if(std::abs(row - 1) < 0.5)
        {
          EXPECT_NEAR(outcome.temperature[i], 0.290530, 1e-4);
        }
      }
      EXPECT_EQ(partly_frozen, 40);
      EXPECT_NEAR(length, 1, 1e-12);
    }

    // The smoothing length and the step that the paper used: 131.94 hours are 3000 steps.
    TEST(Published, UsesThePapersParameters)
    {
      const Outcome sink = run(*method, line_sink(158.333 * 250), 40);
      EXPECT_NEAR(sink.description.smoothing_length, 1.3 / 39, 1e-12);
      EXPECT_NEAR(sink.description.time_step, 158.3333, 1e-3);
      const Outcome plane = run(*method, plane_freezing(), 40);
      EXPECT_NEAR(plane.description.smoothing_length, 1.2 / 39, 1e-12);
    }
  } // namespace
} // namespace meltfront::particles::testing
