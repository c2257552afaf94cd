#include <verification/judge/criteria.h>
#include <verification/judge/reference.h>
#include <verification/measure/measure.h>
#include <verification/record/json_values.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    constexpr double volume_at_end = 0.7;

    /** A run whose solid's volume is off by factor h^order at all times but the start. */
    RunRecord run_of(const std::string &label, int n, double factor, double order)
    {
      RunRecord run;
      run.case_name = "disk";
      run.label = label;
      run.method = label.substr(0, label.find('['));
      run.n = n;
      run.status = RunStatus::finished;
      run.description.spacing = 1. / n;
      const double error = factor * std::pow(1. / n, order);
      run.quantities = {{"solid_volume_end", volume_at_end + error},
                        {"solid_volume_1", 0.3 - error},
                        {"solid_volume_2", std::nan("")},
                        {"budget_defect", 1e-15}};
      // Times of its own, as every method has.
      for(int i = 0; i <= 60 + n % 7; ++i)
      {
        const double t = static_cast<double>(i) / (60 + n % 7);
        run.series.time.push_back(t);
        run.series.solid_volume.push_back(volume_at_end * t * t * t + error);
      }
      return run;
    }

    MatrixResult result_of(std::vector<RunRecord> runs, int reference_n = 64)
    {
      cases::Case c = tests::slab_case("disk");
      c.exact = nullptr;
      c.reference = cases::Reference{"fine[degree=2,scheme=a]", reference_n};
      MatrixResult result;
      result.cases = {StoredCase{c}};
      result.runs = std::move(runs);
      return result;
    }

    std::vector<RunRecord> fine_and_coarse()
    {
      std::vector<RunRecord> runs;
      for(const int n : {8, 16, 32, 64})
      {
        runs.push_back(run_of("fine[degree=2,scheme=a]", n, 0.5, 2));
        runs.push_back(run_of("coarse", n, 0.2, 1));
      }
      return runs;
    }

    TEST(Reference, GivesErrorsAndItsOwnUncertainty)
    {
      MatrixResult result = result_of(fine_and_coarse());
      result.cases[0].reference->label = "fine[ scheme=a, degree=2 ]";
      compare_with_references(result);
      EXPECT_TRUE(result.omissions.empty());
      ASSERT_EQ(result.references.size(), 2u) << "the end and time 1";
      const ReferenceTrust &trust = result.references[0];
      EXPECT_EQ(trust.quantity, "solid_volume_end");
      EXPECT_EQ(trust.n, (std::vector<int>{64, 32, 16}));
      EXPECT_EQ(trust.symbol, "h");
      EXPECT_NEAR(trust.convergence.order, 2, 1e-10);
      EXPECT_NEAR(trust.convergence.extrapolated, volume_at_end, 1e-13);
      const double own_error = 0.5 / 4096;
      EXPECT_GT(trust.bar, own_error);
      for(const RunRecord &run : result.runs)
      {
        const double error = run.quantities.at("solid_volume_end_error");
        if(is_reference(result.cases[0], run))
        {
          EXPECT_TRUE(std::isnan(error));
          EXPECT_TRUE(std::isnan(run.quantities.at("solid_volume_rms_error")));
          continue;
        }
        const double own = run.label == "coarse" ? 0.2 / run.n : 0.5 / (run.n * run.n);
        EXPECT_NEAR(error, std::abs(own - own_error), 1e-15);
        EXPECT_NEAR(run.quantities.at("solid_volume_1_error"), error, 1e-15);
        EXPECT_NEAR(run.quantities.at("solid_volume_end_bars"), error / trust.bar, 1e-12);
        EXPECT_NEAR(run.quantities.at("solid_volume_rms_error"), error, 1e-14)
            << "a cubic course is interpolated exactly";
        EXPECT_TRUE(std::isnan(run.quantities.at("solid_volume_2_error")));
        EXPECT_TRUE(std::isnan(run.quantities.at("front_mode_end_bars")));
      }
    }

    TEST(Reference, ThatIsMissingLeavesNaNAndASentence)
    {
      MatrixResult result = result_of(fine_and_coarse(), 128);
      compare_with_references(result);
      EXPECT_TRUE(result.references.empty());
      ASSERT_EQ(result.omissions.size(), 1u);
      EXPECT_EQ(result.omissions[0],
                "disk: the reference, fine[degree=2,scheme=a] at n = 128, did not run or "
                "did not finish: nothing was compared with it");
      for(const RunRecord &run : result.runs)
        EXPECT_TRUE(std::isnan(run.quantities.at("solid_volume_end_error")));
      MatrixResult failed = result_of(fine_and_coarse());
      for(RunRecord &run : failed.runs)
        if(is_reference(failed.cases[0], run))
          run.status = RunStatus::failed;
      compare_with_references(failed);
      EXPECT_EQ(failed.omissions.size(), 1u);
      MatrixResult nothing = result_of({});
      compare_with_references(nothing);
      EXPECT_TRUE(nothing.omissions.empty());
    }

    TEST(Reference, WithOneCoarserRunHasTheBarOfTwoLevels)
    {
      MatrixResult result = result_of({run_of("fine[degree=2,scheme=a]", 64, 0.5, 2),
                                       run_of("fine[degree=2,scheme=a]", 32, 0.5, 2),
                                       run_of("coarse", 8, 0.2, 1)});
      compare_with_references(result);
      EXPECT_EQ(result.omissions.size(), 1u);
      EXPECT_TRUE(std::isfinite(result.runs[2].quantities.at("solid_volume_end_error")));
      // A method that nobody knows has a factor of 2.5.
      const double bar = 2.5 * (0.5 / 1024 - 0.5 / 4096);
      EXPECT_NEAR(result.references.front().bar, bar, 1e-3 * bar);
      EXPECT_NEAR(result.runs[2].quantities.at("solid_volume_end_bars"),
                  result.runs[2].quantities.at("solid_volume_end_error")
                      / result.references.front().bar,
                  1e-12);
    }

    TEST(Reference, IsJudgedByCriteriaThatLeaveItOutOfItsOwnErrors)
    {
      MatrixResult result = result_of(fine_and_coarse());
      std::vector<RunRecord> runs = fine_and_coarse();
      runs.push_back(run_of("fine[degree=2,scheme=a]", 4, 0.5, 2));
      result.runs = runs;
      cases::Criterion criterion;
      criterion.method = "fine[scheme=a, degree=2]";
      criterion.quantity = "solid_volume_end_error";
      criterion.statistic = cases::Statistic::worst;
      criterion.upper = 0.5 / 16;
      cases::Criterion order = criterion;
      order.statistic = cases::Statistic::order;
      order.lower = 2;
      order.upper = 2.5;
      cases::Criterion of_itself = criterion;
      of_itself.statistic = cases::Statistic::value;
      of_itself.n = 64;
      result.cases[0].criteria = {criterion, order, of_itself};
      compare_with_references(result);
      evaluate(result);
      ASSERT_EQ(result.criteria.size(), 2u);
      EXPECT_NEAR(result.criteria[0].value, 0.5 / 16 - 0.5 / 4096, 1e-14);
      EXPECT_GT(result.criteria[1].value, 2);
      EXPECT_TRUE(result.passed);
      EXPECT_EQ(result.omissions.size(), 1u) << "it has no error from itself at n = 64";
    }

    TEST(Reference, NamesOfItsQuantitiesCanBeAskedFor)
    {
      for(const char *name :
          {"solid_volume_end_error", "solid_volume_4_bars", "front_mode_end_error",
           "solid_volume_rms_error", "solid_volume_1", "iterations_per_step", "dt",
           "most_iterations", "front_points_max", "solid_volume_backsteps"})
        EXPECT_NO_THROW(require_quantity(name)) << name;
    }
  } // namespace
} // namespace meltfront::verification
