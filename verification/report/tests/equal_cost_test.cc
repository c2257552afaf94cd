#include <verification/report/page/report.h>
#include <verification/report/tables/cost_at_error.h>
#include <verification/report/tables/equal_cost.h>
#include <verification/report/tables/growth.h>
#include <verification/report/tests/fixture.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** An explicit method in one dimension beside an implicit one in two: steps ~ n^2 and
     * n, work that is steps x unknowns, time in proportion to it. */
    MatrixResult two_dimensions()
    {
      MatrixResult result;
      result.cases = {fixture::plane_case("plane")};
      for(const int n : {20, 40, 80, 160})
        for(const bool plane : {false, true})
        {
          RunRecord &run = result.runs.emplace_back(
              fixture::run("plane", plane ? "sph-2005" : "sph", n, 0.5, 1.5, 0.01));
          run.description.dimension = plane ? 2 : 1;
          run.cost.unknowns = plane ? n * n : n;
          run.cost.steps = plane ? 10L * n : 10L * n * n;
          run.cost.work = 3 * run.cost.steps * run.cost.unknowns;
          run.cost.stepping_cpu = 1e-8 * static_cast<double>(run.cost.work);
        }
      return result;
    }

    using fixture::count;
  } // namespace

  TEST(Growth, FitsKnownExponents)
  {
    const OrderFit fit = fit_growth({10, 20, 40, 80}, {2e2, 16e2, 128e2, 1024e2});
    EXPECT_NEAR(fit.order, 3, 1e-12);
    EXPECT_NEAR(fit.confidence, 0, 1e-10);
    EXPECT_EQ(fit.verdict, OrderVerdict::clean);
    EXPECT_EQ(fit_growth({10, 20, 40}, {1, 2, 4}).verdict, OrderVerdict::too_few_levels);
    EXPECT_EQ(fit_growth({10, 20, 40, 80}, {1, 2, std::nan(""), 4}).verdict,
              OrderVerdict::not_finite);
  }

  TEST(Growth, TheoryIsThatOfTheStepsTaken)
  {
    const MatrixResult result = two_dimensions();
    const std::string markdown
        = table_markdown(growth_table({collect_runs(result, result.cases[0])}));
    // N = n: steps ~ N^2, and N of work in each; N = n^2: steps ~ N^0.5.
    EXPECT_NE(markdown.find("N^3 (steps ~ h^-2)"), std::string::npos) << markdown;
    EXPECT_NE(markdown.find("N^1.5 (steps ~ h^-1)"), std::string::npos) << markdown;
    EXPECT_EQ(count(markdown, "N^3.00 +- 0.00"), 2u) << markdown; // CPU and work
    EXPECT_EQ(count(markdown, "N^1.50 +- 0.00"), 2u) << markdown;
  }

  TEST(EqualCost, GroupsByDimensionAndMarksTheLeast)
  {
    const MatrixResult result = two_dimensions();
    const CaseRuns runs = collect_runs(result, result.cases[0]);
    EXPECT_EQ(dimensions_of(runs), (std::vector<int>{1, 2}));
    const Table cost = cost_at_equal_error(runs, wanted_errors({runs}));
    ASSERT_EQ(cost.groups.size(), 2u);
    EXPECT_EQ(cost.groups[0].label, "in 1D");
    EXPECT_EQ(cost.groups[1].label, "in 2D");
    // Errors are the same at each n, and the plane is dearer wherever both reach one.
    EXPECT_TRUE(cost.groups[0].rows[0][2].best);
    EXPECT_FALSE(cost.groups[1].rows[0][2].best);
    const Table error = error_at_equal_cost(runs);
    ASSERT_EQ(error.groups.size(), 2u);
    // Nothing takes as little as 1 ms.
    EXPECT_EQ(std::get<NumberText>(error.groups[0].rows[0][1].content).plain(),
              NumberText().plain());
  }

  TEST(EqualCost, ErrorsGoOnToTheFirstThatNobodyReaches)
  {
    const MatrixResult result = two_dimensions(); // relative: 1.25 n^-1.5, 6e-4 at 160
    const CaseRuns runs = collect_runs(result, result.cases[0]);
    EXPECT_EQ(wanted_errors({runs}), (std::vector<double>{1e-2, 1e-3, 1e-4}));
    MatrixResult finer = result;
    finer.runs.push_back(fixture::run("plane", "sph", 4000, 0.5, 1.5, 0.01));
    // 4.9e-6 at 4000
    EXPECT_EQ(wanted_errors({collect_runs(finer, finer.cases[0])}).back(), 1e-6);
  }

  TEST(EqualCost, ARunOfFewTimesIsBoundByItsLargestError)
  {
    MatrixResult result = two_dimensions();
    RunRecord &run = result.runs.front();
    run.quantities["front_rms"] = std::nan("");
    run.quantities["front_max"] = 0.125;
    const CaseRuns runs = collect_runs(result, result.cases[0]);
    EXPECT_EQ(shown_error(runs.labels[0].levels[0], runs), 0.125);
  }

  TEST(EqualCost, DiagramsKeepDimensionsApart)
  {
    const fixture::Directory directory;
    write_report(two_dimensions(), directory.path());
    for(const char *name : {"cpu_seconds-plane__1D", "cpu_seconds-plane__2D",
                            "work-plane__1D", "work-plane__2D"})
      EXPECT_TRUE(directory.has(std::string("plots/work-precision-") + name + ".svg"))
          << name;
  }
} // namespace meltfront::verification
