#include <cases/error.h>
#include <cases/exact/flux_freezing.h>
#include <cases/exact/oracle.h>
#include <cases/exact/tests/materials.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    const Material bar{{2, 0.5, 1}, {1, 1, 1}, 1, 0};
    const double end = 0.9;

    FluxFreezing bar_freezing()
    {
      return FluxFreezing(bar, 1, 1, 0.6, 0);
    }

    /** The oracle that goes on from a moment between onset and the series' end. */
    SpectralOracle continued(double share, int nodes = 0)
    {
      const auto start = std::make_shared<FluxFreezing>(bar_freezing());
      OracleProblem problem;
      problem.material = bar;
      problem.inner_wall = {BoundaryKind::flux, [](double) { return -1.; }};
      problem.start = start;
      problem.start_time = std::lerp(start->onset(), start->end_time(), share);
      problem.end_time = end;
      problem.nodes = nodes;
      return SpectralOracle(problem);
    }
  } // namespace

  TEST(FluxFreezing, IsTheParabolaUntilTheWallFreezes)
  {
    const FluxFreezing freezing = bar_freezing();
    EXPECT_NEAR(freezing.onset(), 0.1, 1e-15);
    EXPECT_EQ(freezing.front(0.05), 0);
    EXPECT_NEAR(freezing.temperature(0.3, 0.05), 0.6 - 0.7 * 0.7 / 2 - 0.05, 1e-15);
    EXPECT_NEAR(freezing.temperature(0., freezing.onset()), 0, 1e-15);
    EXPECT_NEAR(freezing.heat_content(0, 1, 0), 1 + 0.6 - 1. / 6, 1e-14);
  }

  TEST(FluxFreezing, BeginsAsThePowerThreeHalves)
  {
    const FluxFreezing freezing = bar_freezing();
    const double since = 1e-10;
    EXPECT_NEAR(freezing.front(freezing.onset() + since) / std::pow(since, 1.5),
                4 / (3 * std::sqrt(std::numbers::pi)), 1e-4);
  }

  /** In SI units with unequal properties: temperature on both sides of the front and heat
   * drawn against heat missing. */
  TEST(FluxFreezing, MeetsItsConditions)
  {
    const FluxFreezing freezing(water(), 0.5, 500, 300, 100);
    const double initial = freezing.heat_content(0, 0.5, 100);
    for(const double share : {0.01, 0.3, 1.})
    {
      const double time = std::lerp(freezing.onset(), freezing.end_time(), share);
      const double front = freezing.front(time);
      const double step = 1e-9 * front;
      EXPECT_GT(front, 0);
      EXPECT_NEAR(freezing.temperature(front - step, time), 0, 1e-6);
      EXPECT_NEAR(freezing.temperature(front + step, time), 0, 1e-6);
      EXPECT_NEAR(freezing.heat_content(0, 0.5, time), initial - 500 * (time - 100),
                  1e-12 * initial);
    }
  }

  /** Where series and oracle overlap they agree, and the end does not depend on where one
   * hands over to the other nor on the nodes. */
  TEST(FluxFreezing, HandsOverToTheOracleAtAnyMoment)
  {
    const FluxFreezing freezing = bar_freezing();
    const SpectralOracle oracle = continued(1);
    for(const double share : {0.7, 0.4, 0.2})
    {
      const SpectralOracle earlier = continued(share);
      const double between
          = std::lerp(freezing.onset(), freezing.end_time(), (1 + share) / 2);
      EXPECT_NEAR(earlier.front(between), freezing.front(between), 1e-14);
      EXPECT_NEAR(earlier.temperature(0.01, between), freezing.temperature(0.01, between),
                  1e-14);
      EXPECT_NEAR(earlier.front(end), oracle.front(end), 1e-13);
    }
    for(const int nodes : {40, 60})
      EXPECT_NEAR(continued(1, nodes).front(end), oracle.front(end), 1e-12);
  }

  /** The heat that the flux drew is missing: nothing in the equations is used for it but
   * conservation. */
  TEST(FluxFreezing, TheOracleLosesTheHeatThatTheFluxDraws)
  {
    const SpectralOracle oracle = continued(1);
    const double initial = oracle.heat_content(0, 1, 0);
    for(const double time : {0.05, 0.102, 0.3, 0.9})
      EXPECT_NEAR(oracle.heat_content(0, 1, time), initial - time, 1e-11) << time;
  }

  TEST(FluxFreezing, RefusesWhatItDoesNotSolve)
  {
    EXPECT_THROW(FluxFreezing(bar, 1, 1, 0.4, 0), InputError);
    EXPECT_THROW(FluxFreezing(bar, 1, -1, 0.6, 0), InputError);
    EXPECT_THROW(FluxFreezing(bar, 0, 1, 0.6, 0), InputError);
    EXPECT_THROW(FluxFreezing(water(917), 1, 1, 300, 0), InputError);
    EXPECT_THROW(bar_freezing().front(-0.1), InputError);
    EXPECT_THROW(bar_freezing().temperature(0.5, 0.2), InputError);
  }
} // namespace meltfront::cases
