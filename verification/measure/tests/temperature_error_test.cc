#include <verification/measure/formulas/temperature_error.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    using tests::State;

    /** Exact temperature x - 0.5 at t = 1. */
    State exact_state()
    {
      State state;
      for(const double x : {0.1, 0.3, 0.9})
      {
        state.positions[0].push_back(x);
        state.temperature.push_back(x - 0.5);
        state.solid_fraction.push_back(x < 0.5 ? 1 : 0);
      }
      state.weights = {0.2, 0.2, 0.6};
      return state;
    }

    const tests::LinearProfile profile(cases::Symmetry::planar);

    TemperatureError error_of(State &state, double from = 0, double to = 1,
                              double melting_temperature = 0)
    {
      return temperature_error(state.view(1, 1), state.positions[0], profile,
                               melting_temperature, from, to);
    }

    TEST(TemperatureError, VanishesForTheExactTemperature)
    {
      State state = exact_state();
      const TemperatureError error = error_of(state);
      EXPECT_EQ(error.l2, 0);
      EXPECT_EQ(error.maximum, 0);
      EXPECT_EQ(error.rmse, 0);
    }

    TEST(TemperatureError, FollowsItsDefinitions)
    {
      State state = exact_state();
      state.temperature[0] += 0.02;
      state.temperature[2] -= 0.04;
      const TemperatureError error = error_of(state);
      const double squares = 0.2 * 0.02 * 0.02 + 0.6 * 0.04 * 0.04;
      const double reference = 0.2 * 0.16 + 0.2 * 0.04 + 0.6 * 0.16;
      EXPECT_NEAR(error.l2, std::sqrt(squares / reference), 1e-15);
      EXPECT_NEAR(error.maximum, 0.04 / 0.4, 1e-15);
      EXPECT_NEAR(error.rmse, std::sqrt((0.02 * 0.02 + 0.04 * 0.04) / 3) / 0.4, 1e-15);
    }

    TEST(TemperatureError, RelatesToTheMeltingPointAndTheRmseToZero)
    {
      State state = exact_state();
      state.temperature[1] += 0.1;
      const TemperatureError error = error_of(state, 0, 1, -0.6);
      EXPECT_NEAR(error.maximum, 0.1 / 1.0, 1e-15);
      EXPECT_NEAR(error.rmse, std::sqrt(0.01 / 3) / 0.4, 1e-15);
    }

    TEST(TemperatureError, LooksOnlyBetweenTheCoordinatesAndAtSitesWithAVolume)
    {
      State state = exact_state();
      state.temperature[0] = 100;
      EXPECT_EQ(error_of(state, 0.2, 1).maximum, 0);
      EXPECT_GT(error_of(state, 0.1, 1).maximum, 1);
      state.weights[0] = 0;
      EXPECT_EQ(error_of(state).maximum, 0);
      EXPECT_TRUE(std::isnan(error_of(state, 2, 3).l2));
      EXPECT_TRUE(std::isnan(error_of(state, 2, 3).rmse));
    }

    TEST(TemperatureError, IsNaNForATemperatureThatIsNaN)
    {
      State state = exact_state();
      state.temperature[1] = std::nan("");
      const TemperatureError error = error_of(state);
      EXPECT_TRUE(std::isnan(error.l2));
      EXPECT_TRUE(std::isnan(error.maximum));
      EXPECT_TRUE(std::isnan(error.rmse));
    }
  } // namespace
} // namespace meltfront::verification
