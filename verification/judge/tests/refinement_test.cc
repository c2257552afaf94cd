#include <verification/judge/criteria.h>
#include <verification/judge/refinement.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    RunRecord run_of(int n, double spacing, double time_step)
    {
      RunRecord run;
      run.case_name = "slab";
      run.method = run.label = "fitted";
      run.n = n;
      run.status = RunStatus::finished;
      run.description.spacing = spacing;
      run.description.time_step = time_step;
      run.options["degree"] = "4";
      return run;
    }

    /** Runs of a scheme of an order in time, at one spacing or at n^-1. */
    std::vector<RunRecord> runs_of_order(double order, bool in_time)
    {
      std::vector<RunRecord> runs;
      for(const int n : {10, 20, 40, 80, 160, 320})
      {
        runs.push_back(run_of(n, in_time ? 0.1 : 1. / n, 1. / n));
        runs.back().quantities["front_end"]
            = std::max(3 * std::pow(1. / n, order), 5e-14);
      }
      return runs;
    }

    std::vector<const RunRecord *> pointers(const std::vector<RunRecord> &runs)
    {
      std::vector<const RunRecord *> list;
      for(const RunRecord &run : runs)
        list.push_back(&run);
      return list;
    }

    TEST(Refinement, IsOfTimeWhereOnlyTheTimeStepDiffers)
    {
      const auto in_time = runs_of_order(3, true), in_space = runs_of_order(3, false);
      EXPECT_TRUE(Refinement(pointers(in_time)).in_time());
      EXPECT_EQ(Refinement(pointers(in_time)).symbol(), "dt");
      EXPECT_EQ(Refinement(pointers(in_time)).of(in_time[1]), 0.05);
      EXPECT_FALSE(Refinement(pointers(in_space)).in_time());
      EXPECT_EQ(Refinement(pointers(in_space)).symbol(), "h");
      EXPECT_EQ(Refinement(pointers(in_space)).of(in_space[2]), 1. / 40);
      // One run, runs without a time step, and seeds of one n say nothing of time.
      EXPECT_FALSE(Refinement({&in_time[0]}).in_time());
      EXPECT_FALSE(Refinement({&in_time[0], &in_time[0]}).in_time());
      EXPECT_FALSE(Refinement().in_time());
      const RunRecord unknown = run_of(20, 0.1, 0);
      EXPECT_FALSE(Refinement({&in_time[0], &unknown}).in_time());
      RunRecord failed = run_of(20, 0, 0);
      failed.status = RunStatus::failed;
      EXPECT_TRUE(Refinement({&failed, &in_time[0], &in_time[1]}).in_time());
    }

    TEST(RoundOffFloor, IsRelativeToTheSizeOfTheDomain)
    {
      cases::Case c = tests::slab_case("slab");
      c.scene.domain.upper[0] = 0.2;
      const StoredCase slab = StoredCase{c};
      EXPECT_DOUBLE_EQ(round_off_floor(slab, "front_end"), 2e-14);
      EXPECT_DOUBLE_EQ(round_off_floor(slab, "solid_volume_end_error"), 2e-14);
      EXPECT_DOUBLE_EQ(round_off_floor(slab, "front_rms_relative"), 1e-13);
      EXPECT_DOUBLE_EQ(round_off_floor(slab, "temperature_l2"), 1e-13);
      c.scene = tests::scene_of(cases::DomainShape::shell, 2, cases::Symmetry::none);
      c.scene.domain.radius = 2;
      c.scene.domain.inner_radius = 0.5;
      const StoredCase shell = StoredCase{c};
      EXPECT_DOUBLE_EQ(round_off_floor(shell, "solid_volume_1_error"), 16e-13);
    }

    TEST(PlausibleOrder, KnowsTheDegreeOfElements)
    {
      const auto in_space = runs_of_order(2, false), in_time = runs_of_order(2, true);
      const Refinement space(pointers(in_space)), time(pointers(in_time));
      RunRecord run;
      EXPECT_EQ(plausible_order(run, space), 3);
      EXPECT_EQ(plausible_order(run, time), 5.5);
      run.options["degree"] = "4";
      EXPECT_EQ(plausible_order(run, space), 8.5);
      run.options["degree"] = "1";
      EXPECT_EQ(plausible_order(run, space), 3);
    }

    double fitted_order(bool in_time, double order)
    {
      MatrixResult result;
      result.cases = {StoredCase{tests::slab_case("slab")}};
      cases::Criterion criterion;
      criterion.method = "fitted";
      criterion.quantity = "front_end";
      criterion.statistic = cases::Statistic::order;
      criterion.lower = order - 0.1;
      criterion.upper = order + 0.1;
      result.cases[0].criteria = {criterion};
      result.runs = runs_of_order(order, in_time);
      evaluate(result);
      EXPECT_TRUE(result.passed);
      return result.criteria.at(0).value;
    }

    TEST(Criteria, FitOrdersOverTheTimeStepAndAboveRoundOff)
    {
      EXPECT_NEAR(fitted_order(true, 3), 3, 1e-12);
      EXPECT_NEAR(fitted_order(true, 5.4), 5.4, 1e-12) << "a level is at round-off";
      EXPECT_NEAR(fitted_order(false, 4), 4, 1e-12);
    }
  } // namespace
} // namespace meltfront::verification
