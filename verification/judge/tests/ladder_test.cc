#include <verification/judge/coverage.h>
#include <verification/judge/ladder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace meltfront;
using namespace meltfront::verification;

namespace
{
  constexpr double end_of_front = 0.5;

  /** A run whose front is 0.5 sqrt(t) (1 + error h^2), whose temperature x + error h^2.
   */
  RunRecord made_run(int n, double error, const std::string &method = "fem-cut")
  {
    RunRecord run;
    run.case_name = "slab";
    run.method = run.label = method;
    run.n = n;
    run.status = RunStatus::finished;
    run.description.spacing = 1. / n;
    run.cost.steps = 4L * n * n;
    const double relative = error / (n * n);
    // Times that differ between levels.
    const int samples = 60 + n % 7;
    for(int i = 0; i <= samples; ++i)
    {
      const double t = static_cast<double>(i) / samples;
      run.series.time.push_back(t);
      run.series.front.push_back(end_of_front * std::sqrt(t) * (1 + relative));
      run.series.front_exact.push_back(end_of_front * std::sqrt(t));
      run.series.solid_volume.push_back(run.series.front.back());
      run.series.heat.push_back(-run.series.front.back());
    }
    run.solid_volume_exact = end_of_front;
    for(const double x : {.1, .3, .5, .7, .9})
      run.probes.push_back({"x", {x}, x + relative, x});
    return run;
  }

  MatrixResult made_result(const std::vector<int> &levels, double error = 1)
  {
    MatrixResult result;
    for(const int n : levels)
      result.runs.push_back(made_run(n, error));
    return result;
  }

  const QuantityBar &bar_named(const std::vector<QuantityBar> &bars,
                               const std::string &name)
  {
    for(const QuantityBar &bar : bars)
      if(bar.quantity == name)
        return bar;
    throw std::runtime_error("no bar of " + name);
  }
} // namespace

TEST(Ladder, OfLevelsThatMayAllMissALayerTellsNoLess)
{
  MatrixResult result = made_result({10, 20, 40}, 0);
  result.runs.back().quantities = {{"solid_volume_unseen", 0.0125}, {"front_unseen", 0}};
  const auto bars = bars_of(ladders_of(result).front());
  const ErrorBar &volume = bar_named(bars, "solid_volume").bar;
  EXPECT_EQ(volume.bar, 0.0125);
  EXPECT_NE(volume.remark.find("a layer at a wall"), std::string::npos);
  EXPECT_LT(bar_named(bars, "front").bar.bar, 1e-9);
}

TEST(Ladder, SecondOrderGivesTheFactorTimesTheError)
{
  const MatrixResult result = made_result({10, 20, 40});
  const auto ladders = ladders_of(result);
  ASSERT_EQ(ladders.size(), 1u);
  const auto bars = bars_of(ladders.front());
  const double error = end_of_front / 1600;
  const QuantityBar &front = bar_named(bars, "front");
  EXPECT_NEAR(front.bar.observed, 2, 1e-3);
  EXPECT_NEAR(front.error, error, 1e-12);
  // Differences over the second half of the time are smaller than that at the end.
  EXPECT_LT(front.bar.bar, 1.5 * error * (1 + 1e-6));
  EXPECT_GT(front.bar.bar, 1.5 * error * .85);
  EXPECT_NEAR(bar_named(bars, "solid_volume").error, error, 1e-12);
  EXPECT_NEAR(bar_named(bars, "heat").bar.value, -end_of_front - error, 1e-12);
  const QuantityBar &temperature = bar_named(bars, "temperature at x = 0.3");
  EXPECT_NEAR(temperature.bar.bar, 1.25 / 1600, 1e-9);
  EXPECT_NEAR(temperature.error, 1. / 1600, 1e-12);
}

TEST(Ladder, LevelsAreSortedAndEachSpacingIsTakenOnce)
{
  MatrixResult result = made_result({40, 10, 20, 20});
  result.runs.push_back(made_run(80, 1));
  result.runs.back().status = RunStatus::failed;
  const auto ladders = ladders_of(result);
  ASSERT_EQ(ladders.size(), 1u);
  ASSERT_EQ(ladders.front().levels.size(), 3u);
  EXPECT_EQ(ladders.front().levels.front()->n, 10);
  EXPECT_EQ(ladders.front().levels.back()->n, 40);
  EXPECT_TRUE(ladders.front().finest_failed);
}

TEST(Ladder, SeedsAreLaddersOfTheirOwn)
{
  MatrixResult result = made_result({10, 20});
  result.runs.push_back(made_run(10, 2));
  result.runs.back().seed = 2;
  EXPECT_EQ(ladders_of(result).size(), 2u);
}

/** Levels that agree by chance say nothing against one that does not, nor against the
 * heat that the finest lacks. */
TEST(Ladder, ALevelThatDiffersAndHeatThatIsMissingWidenTheBar)
{
  MatrixResult result;
  for(const int n : {20, 40, 80})
    result.runs.push_back(made_run(n, 1, "fem-enthalpy"));
  const auto bar_of = [&](const char *name)
  { return bar_named(bars_of(ladders_of(result).front()), name).bar.bar; };
  const double regular = bar_of("front");
  for(RunSeries *series : {&result.runs[1].series, &result.runs[2].series})
    series->front = result.runs[1].series.front;
  result.runs[2].series.time = result.runs[1].series.time;
  result.runs[2].series.front_exact = result.runs[1].series.front_exact;
  EXPECT_GT(bar_of("front"), 0.5 * regular);

  RunSeries &finest = result.runs[2].series;
  finest.heat.resize(finest.time.size(), finest.heat.back());
  const double before = bar_of("heat");
  finest.budget_defect.assign(finest.time.size(), 0.1);
  EXPECT_NEAR(bar_of("heat"), 0.1 * std::abs(finest.heat.back()), 1e-9);
  EXPECT_LT(before, bar_of("heat"));
}

TEST(Ladder, ARunAtHalfTheStepTellsTheErrorOfTheStep)
{
  MatrixResult result = made_result({10, 20, 40});
  for(RunRecord &run : result.runs)
    run.cost.steps = 50;
  EXPECT_TRUE(hides_time_error(ladders_of(result).front()));
  const double hidden = bar_named(bars_of(ladders_of(result).front()), "front").bar.bar;
  // Backward Euler whose error is 1e-4 t.
  RunRecord half = made_run(40, 1);
  half.label = "fem-cut[steps=100]";
  half.options["steps"] = "100";
  half.cost.steps = 100;
  for(RunRecord &run : result.runs)
    run.options = {{"steps", "50"}, {"time_scheme", "backward-euler"}};
  half.options["time_scheme"] = "backward-euler";
  for(std::size_t i = 0; i < half.series.time.size(); ++i)
    half.series.front[i] -= .5e-4 * half.series.time[i];
  result.runs.push_back(half);
  const auto ladders = ladders_of(result);
  ASSERT_EQ(ladders.size(), 1u) << "it is no answer of its own";
  const Ladder &ladder = ladders.front();
  EXPECT_EQ(ladder.whole_step->n, 40);
  ASSERT_TRUE(ladder.half_step);
  const auto bars = bars_of(ladder);
  const QuantityBar &front = bar_named(bars, "front");
  EXPECT_EQ(front.bar.remark, "time error measured at half the step");
  EXPECT_NEAR(front.bar.order, 2, 1e-3);
  const double space = end_of_front / 1600;
  EXPECT_LT(front.bar.bar, 1.5 * (space + 1e-4) * (1 + 1e-6));
  EXPECT_GT(front.bar.bar, 1.5 * (space + 1e-4) * .85);
  EXPECT_LT(front.bar.bar, hidden);
  // It says nothing of ladders that do not reach the level.
  Ladder coarse = ladder;
  coarse.levels.resize(2);
  EXPECT_EQ(bar_named(bars_of(coarse), "front").bar.remark,
            "two levels; time step not refined: its error is not measured");
  // Other options are another method.
  result.runs.back().options["time_scheme"] = "bdf2";
  EXPECT_FALSE(ladders_of(result).front().half_step);
}

TEST(Ladder, StepsRefinedWithSpaceHideNothing)
{
  EXPECT_FALSE(hides_time_error(ladders_of(made_result({10, 20, 40})).front()));
  EXPECT_FALSE(hides_time_error(ladders_of(made_result({10})).front()));
}

TEST(Ladder, OneLevelHasNoBar)
{
  const MatrixResult result = made_result({10});
  const auto bars = bars_of(ladders_of(result).front());
  EXPECT_TRUE(std::isnan(bar_named(bars, "front").bar.bar));
}

TEST(Coverage, CountsWhatTheBarsHold)
{
  MatrixResult result = made_result({10, 20, 40, 80});
  const auto coverage = coverage_of(result);
  int rows = 0;
  for(const Coverage &row : coverage)
    if(row.quantity == "front")
    {
      ++rows;
      EXPECT_EQ(row.covered, row.instances);
      EXPECT_EQ(row.instances, row.levels == 2 ? 1 : 2);
    }
  EXPECT_EQ(rows, 2);
  // A limit that is not the exact solution cannot be covered.
  for(RunRecord &run : result.runs)
    for(double &exact : run.series.front_exact)
      exact += 0.01;
  for(const Coverage &row : coverage_of(result))
    if(row.quantity == "front" && row.levels == 3)
    {
      EXPECT_EQ(row.covered, 0);
    }
  EXPECT_TRUE(coverage_csv(coverage).starts_with(
      "method,quantity,levels,covered,median_bar_over_error"));
}
