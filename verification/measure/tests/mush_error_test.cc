#include <verification/measure/formulas/mush_error.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront;
using namespace meltfront::verification;

namespace
{
  tests::State exact_state()
  {
    tests::State state;
    state.positions[0] = {0.125, 0.375, 0.625, 0.875};
    state.weights = {0.25, 0.25, 0.25, 0.25};
    state.temperature = {-0.375, -0.125, 0.125, 0.375};
    state.solid_fraction = {0.5, 0.5, 0, 0};
    state.concentration[0] = {0.1, 0.1, 0.1, 0.1};
    return state;
  }

  MushError error_of(tests::State &state, double from = 0, double to = 1)
  {
    const std::vector<double> coordinates = state.positions[0];
    return mush_error(state.view(1, 1), coordinates, tests::HalfFrozen(), from, to, 0, 1);
  }
} // namespace

TEST(MushError, VanishesForTheExactState)
{
  tests::State state = exact_state();
  const MushError error = error_of(state);
  EXPECT_NEAR(error.temperature_rms, 0, 1e-15);
  EXPECT_EQ(error.solid_fraction_rms, 0);
  EXPECT_NEAR(error.concentration_rms, 0, 1e-16);
  EXPECT_NEAR(error.ice_error, 0, 1e-15);
}

TEST(MushError, CountsEachDeviationByItsVolume)
{
  tests::State state = exact_state();
  state.temperature[1] += 0.2;
  state.solid_fraction[0] = 0.6;
  const MushError error = error_of(state);
  EXPECT_NEAR(error.temperature_rms, 0.1, 1e-15);
  EXPECT_NEAR(error.solid_fraction_rms, 0.05, 1e-15);
  EXPECT_NEAR(error.concentration_rms, (0.1 / 0.4 - 0.2) / 2, 1e-15);
  EXPECT_NEAR(error.ice_error, 0.1, 1e-14);
}

TEST(MushError, ComparesOnlyWhereItIsToldTo)
{
  tests::State state = exact_state();
  state.temperature[0] += 1;
  EXPECT_NEAR(error_of(state, 0.2, 1).temperature_rms, 0, 1e-15);
}

TEST(MushError, NothingToCompareIsNoNumber)
{
  tests::State state = exact_state();
  EXPECT_TRUE(std::isnan(error_of(state, 2, 3).temperature_rms));
  state.concentration[0].clear();
  EXPECT_TRUE(std::isnan(error_of(state).concentration_rms));
  EXPECT_TRUE(std::isnan(liquid_concentration(0.1, 1)));
}
