#include <verification/judge/error_bar.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace meltfront;
using namespace meltfront::verification;

namespace
{
  /** Ladders of runs that were made: their values, differences in time norm, and the bar
   * that a calculation apart from this code gives. */
  struct WorkedLadder
  {
    std::string name;
    std::vector<BarLevel> levels;
    std::vector<double> differences;
    BarRecipe recipe;
    double observed, order, bar;
  };

  const double none = cases::nan;

  const std::vector<WorkedLadder> &worked_ladders()
  {
    static const std::vector<WorkedLadder> ladders{
        {"fem-enthalpy, plane-freezing",
         {{1. / 64, 53, .238468221},
          {1. / 128, 103, .238359146},
          {1. / 256, 203, .238248165}},
         {5.72983e-4, 2.12839e-4},
         {.238, 2, 2, 1.5},
         1.4287,
         1.4287,
         1.50462e-4},
        {"rkpm-tracked, plane-freezing",
         {{1. / 80, 127, .238199612},
          {1. / 160, 253, .238298729},
          {1. / 320, 504, .238321927}},
         {1.06724e-4, 2.46572e-5},
         {.238, 2, 2, 2},
         2.1138,
         1.98857,
         1.6129e-5},
        {"sph-2005, line-sink-strong",
         {{1. / 39, 2000, .227453945},
          {1. / 49, 3158, .227915526},
          {1. / 79, 8207, .229110636}},
         {7.72097e-4, 1.13265e-3},
         {.229, .75, 1, 2},
         1.0282,
         .75,
         5.40552e-3},
        {"sph, plane-contrast, equal values",
         {{1. / 40, 960, .289767205}, {1. / 80, 220, .2875}, {1. / 160, 878, .2875}},
         {2.08216e-3, 6.90122e-4},
         {.2875, 2, 2, 1.75},
         1.5932,
         1.5932,
         4.2337e-4},
        {"two levels",
         {{1. / 128, 103, .238359146}, {1. / 256, 203, .238248165}},
         {2.12839e-4},
         {.238, 2, 2, 1.5},
         none,
         1,
         3.39462e-4},
        {"equal steps",
         {{1. / 8, 50, .5001}, {1. / 16, 50, .50001}, {1. / 32, 50, .500009}},
         {1e-4, 1e-6},
         {.5, 8, 5, 1.5},
         6.644,
         1,
         1.5e-6}};
    return ladders;
  }
} // namespace

TEST(ErrorBar, WorkedLadders)
{
  for(const WorkedLadder &worked : worked_ladders())
  {
    SCOPED_TRACE(worked.name);
    const ErrorBar bar = error_bar(worked.levels, worked.differences, worked.recipe);
    EXPECT_TRUE(bar.converging);
    EXPECT_EQ(bar.value, worked.levels.back().value);
    EXPECT_NEAR(bar.bar, worked.bar, 1e-4 * worked.bar);
    EXPECT_NEAR(bar.order, worked.order, 1e-4 * worked.order);
    if(!std::isnan(worked.observed))
    {
      EXPECT_NEAR(bar.observed, worked.observed, 1e-4 * worked.observed);
    }
  }
}

TEST(ErrorBar, SaysWhatItDoesNotMeasure)
{
  const auto of = [](const char *name)
  {
    for(const WorkedLadder &worked : worked_ladders())
      if(worked.name == name)
        return error_bar(worked.levels, worked.differences, worked.recipe).remark;
    return std::string("no such ladder");
  };
  EXPECT_EQ(of("equal steps"), "time step not refined: its error is not measured");
  EXPECT_EQ(of("two levels"), "two levels");
  EXPECT_EQ(of("rkpm-tracked, plane-freezing"), "");
}

TEST(ErrorBar, DifferencesThatGrowAreNoBar)
{
  const std::vector<BarLevel> levels{{1. / 80, 128, .270073981},
                                     {1. / 160, 255, .269247489},
                                     {1. / 320, 508, .267370362}};
  const ErrorBar bar
      = error_bar(levels, std::vector{5.7623e-4, 1.46843e-3}, {.27, 2, 2, 2});
  EXPECT_FALSE(bar.converging);
  EXPECT_EQ(bar.observed, -1);
  EXPECT_NEAR(bar.bar, 5.63138e-3, 1e-4 * 5.63138e-3);
  EXPECT_EQ(bar.remark, "not converging");
}

TEST(ErrorBar, RoundOffIsItsFloor)
{
  const std::vector<BarLevel> levels{{.1, 10, 2.}, {.05, 20, 2.}, {.025, 40, 2. + 1e-15}};
  const ErrorBar bar = error_bar(levels, std::vector{1e-15, 1e-15}, {2., 8, 5, 1.5});
  EXPECT_TRUE(bar.converging);
  EXPECT_EQ(bar.bar, 2e-12);
}

TEST(ErrorBar, AtTheFloorOfItsSolverALabelHasConverged)
{
  // Differences that grow, of 1e-10 of the size.
  const std::vector<BarLevel> levels{
      {.1, 10, 2.}, {.05, 20, 2. + 1e-10}, {.025, 40, 2. - 2e-10}};
  BarRecipe recipe{2., 8, 5, 1.5};
  EXPECT_FALSE(error_bar(levels, std::vector{1e-10, 3e-10}, recipe).converging);
  recipe.floor = 1e-9;
  const ErrorBar bar = error_bar(levels, std::vector{1e-10, 3e-10}, recipe);
  EXPECT_TRUE(bar.converging);
  EXPECT_EQ(bar.bar, 2e-9);
  EXPECT_EQ(bar.remark, "at the floor of its solver");
}

TEST(ErrorBar, AllPairsDoNotBelieveTheFinestTwoThatAgreeByChance)
{
  // f = 1 + h but for the finest, which agrees with the second by chance.
  const std::vector<BarLevel> levels{{.1, 10, 1.1}, {.05, 20, 1.05}, {.025, 40, 1.05}};
  const std::vector<double> differences{.05, .0125};
  BarRecipe recipe{1., 1, 2, 1.25};
  const double finest = error_bar(levels, differences, recipe).bar;
  EXPECT_NEAR(finest, 1.25 * .0125 / std::sqrt(2.), 1e-12);
  recipe.all_pairs = true;
  EXPECT_NEAR(error_bar(levels, differences, recipe).bar, 1.25 * .025, 1e-12);
}

TEST(ErrorBar, ARunAtHalfTheStepFreesTheOrderAndAddsItsError)
{
  // Spatial differences of order 4 at equal steps; the step's error is 1e-6.
  const std::vector<BarLevel> levels{
      {.1, 50, 1 + 256e-6}, {.05, 50, 1 + 16e-6}, {.025, 50, 1 + 1e-6}};
  BarRecipe recipe{1., 4, 5, 1.5};
  EXPECT_GT(error_bar(levels, std::vector{none, none}, recipe).bar, 20e-6);
  recipe.time_error = error_of_step(31e-6 / 32, none, 2, 5);
  EXPECT_NEAR(recipe.time_error, 1e-6, 1e-15);
  const ErrorBar bar = error_bar(levels, std::vector{none, none}, recipe);
  EXPECT_NEAR(bar.bar, 1.5 * 2e-6, 1e-12);
  EXPECT_EQ(bar.remark, "time error measured at half the step");
}

TEST(ErrorBar, ValuesWithoutNormsUseTheirDifferences)
{
  // f = 1 + h^2: the bar is F times the exact error.
  const std::vector<BarLevel> levels{
      {.1, 100, 1.01}, {.05, 400, 1.0025}, {.025, 1600, 1.000625}};
  const ErrorBar bar = error_bar(levels, std::vector{none, none}, {1., 2, 1, 1.25});
  EXPECT_NEAR(bar.observed, 2, 1e-9);
  EXPECT_NEAR(bar.bar, 1.25 * .000625, 1e-12);
}

TEST(ErrorBar, TwoValuesThatAgreeByChance)
{
  const std::vector<BarLevel> levels{{.1, 100, .5}, {.05, 400, .5}};
  EXPECT_NEAR(error_bar(levels, std::vector{none}, {.5, 2, 1, 1.5}).bar, .05 * .05,
              1e-15);
}

TEST(ErrorBar, OneLevelHasNone)
{
  const std::vector<BarLevel> levels{{.1, 100, .5}};
  const ErrorBar bar = error_bar(levels, {}, {.5, 2, 1, 1.5});
  EXPECT_EQ(bar.value, .5);
  EXPECT_TRUE(std::isnan(bar.bar));
  EXPECT_FALSE(bar.converging);
}

TEST(ErrorBar, KnowsTheSchemeOfARun)
{
  RunRecord run;
  run.method = "fem-fitted";
  run.options = {{"degree", "3"}, {"time_scheme", "radau3"}};
  EXPECT_EQ(bar_constants(run).front.order, 6);
  EXPECT_EQ(bar_constants(run).order_in_time, 3);
  run.method = "rkpm-tracked";
  run.options = {{"time_scheme", "backward-euler"}};
  EXPECT_EQ(bar_constants(run).order_in_time, 1);
  EXPECT_EQ(bar_constants(run).front.order, 1.5);
  run.description.dimension = 2;
  EXPECT_EQ(bar_constants(run).order_in_time, 1);
  EXPECT_EQ(bar_constants(run).front.factor, 1.5);
  EXPECT_EQ(bar_constants(run).front.order, 1.5);
  run.description.parameters = {{"start", "sph with 80 particles along the side", ""}};
  EXPECT_EQ(bar_constants(run).front.order, 1);
  run.method = "a method of tomorrow";
  EXPECT_EQ(bar_constants(run).front.factor, 2.5);
}

TEST(ErrorBar, NoLevelsTellTheErrorOfAMethodThatConvergesElsewhere)
{
  RunRecord run;
  run.method = "sph-two-population-2005";
  const BarConstants constants = bar_constants(run);
  const std::vector<BarLevel> levels{{.4, 10, 1}, {.2, 20, .9}, {.1, 40, .85}};
  const ErrorBar bar = error_bar(levels, std::vector<double>{.1, .05},
                                 bar_recipe(constants, constants.front, 1));
  EXPECT_TRUE(std::isnan(bar.bar));
  EXPECT_FALSE(bar.converging);
  EXPECT_EQ(bar.value, .85);
}

/** In the plane sph is of second order where fronts are lines, else of first. */
TEST(ErrorBar, TrustsWhatTheFrontsOfARunAre)
{
  RunRecord run;
  run.method = "sph";
  run.description.dimension = 2;
  EXPECT_EQ(bar_constants(run).front.order, 1);
  run.description.parameters.push_back(
      {"exchange at fronts", "front as a line or a plane through the particles about it",
       ""});
  EXPECT_EQ(bar_constants(run).front.order, 1.5);
  EXPECT_EQ(bar_constants(run).heat.factor, 1.25);
  run.description.dimension = 1;
  EXPECT_EQ(bar_constants(run).heat.factor, 2);
}
