#include <verification/judge/median_course.h>
#include <verification/judge/stability.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::verification;
namespace cases = meltfront::cases;

namespace
{
  /** A solution whose front runs from 0.1 to 0.3 of the slab between t = 0 and 1. */
  class MovingFront : public cases::ExactSolution
  {
  public:
    std::string description() const override
    {
      return "a front that runs evenly";
    }

    cases::Symmetry symmetry() const override
    {
      return cases::Symmetry::planar;
    }

    double temperature(double, double) const override
    {
      return 0;
    }

    double front(double time) const override
    {
      return 0.1 + 0.2 * time;
    }

    double heat_content(double, double, double) const override
    {
      return 0;
    }
  };

  /** A temperature without a front. */
  class Decay : public MovingFront
  {
  public:
    bool has_front() const override
    {
      return false;
    }
  };

  StoredCase unit_slab(bool with_exact)
  {
    StoredCase record;
    record.scene.name = "hard";
    record.scene.end_time = 1;
    record.scene.domain.upper = {1, 0, 0};
    record.scene.material.latent_heat = 1;
    if(with_exact)
      record.exact = std::make_shared<MovingFront>();
    return record;
  }

  /** A run of 51 samples whose front is off by so much. */
  RunRecord run_of(const std::string &method, double off, int n = 40)
  {
    RunRecord run;
    run.case_name = "hard";
    run.method = run.label = method;
    run.n = n;
    run.description.spacing = 1. / n;
    run.cost.steps = 200;
    run.status = RunStatus::finished;
    for(int i = 0; i <= 50; ++i)
    {
      const double time = i / 50.;
      run.series.time.push_back(time);
      run.series.front_exact.push_back(0.1 + 0.2 * time);
      run.series.solid_volume.push_back(0.1 + 0.2 * time + off);
      run.series.temperature_min.push_back(0);
      run.series.temperature_max.push_back(1);
    }
    run.series.front = run.series.solid_volume;
    run.quantities = {
        {"budget_defect", 1e-15}, {"front_backsteps", 0.}, {"front_rms", std::abs(off)}};
    run.checks
        = {{"maximum principle", 0, 1e-9, true}, {"heat balance", 1e-15, 1e-6, true}};
    return run;
  }

  MatrixResult matrix_of(const std::vector<RunRecord> &runs, bool with_exact = true)
  {
    MatrixResult result;
    result.hard_cases = true;
    result.cases = {unit_slab(with_exact)};
    result.runs = runs;
    return result;
  }

  StabilityVerdict verdict_of(const RunRecord &run)
  {
    const auto verdicts = judge_stability(matrix_of({run}));
    EXPECT_EQ(verdicts.size(), 1u);
    return verdicts.at(0);
  }

  RunRecord unguarded(double factor)
  {
    RunRecord run = run_of("sph", 0.001);
    run.options = {{"step_limit", "stability"}, {"step_factor", std::to_string(factor)}};
    return run;
  }
} // namespace

TEST(Stability, ARunNearTheExactSolutionHoldsAndSaysWhatDecided)
{
  const StabilityVerdict verdict = verdict_of(run_of("sph", 0.001));
  EXPECT_EQ(verdict.verdict, "held");
  EXPECT_EQ(verdict.reason, "");
  EXPECT_EQ(verdict.n, 40);
  ASSERT_EQ(verdict.measures.size(), 5u);
  EXPECT_EQ(verdict.measures[0].name, "front");
  EXPECT_DOUBLE_EQ(verdict.measures[0].value, 0.001);
  EXPECT_DOUBLE_EQ(verdict.measures[0].bound, 2. / 40);
}

TEST(Stability, AFrontFarFromTheExactOneFails)
{
  const StabilityVerdict verdict = verdict_of(run_of("sph", 0.06));
  EXPECT_EQ(verdict.verdict, "failed");
  EXPECT_EQ(verdict.reason, "front is 0.06, more than 0.05");
  // On a coarse lattice what is within two spacings may be all of the way.
  EXPECT_EQ(verdict_of(run_of("sph", 0.09, 20)).verdict, "held");
  EXPECT_EQ(verdict_of(run_of("sph", 0.2 / std::sqrt(3.), 20)).verdict, "failed");
  const auto bound_of_front
      = [](int n) { return verdict_of(run_of("sph", 1e-3, n)).measures[0].bound; };
  EXPECT_DOUBLE_EQ(bound_of_front(10), 0.1); // half of the way
  EXPECT_DOUBLE_EQ(bound_of_front(5), 0.2);  // a spacing
}

TEST(Stability, WhereNoPhaseChangesTheTemperatureIsJudged)
{
  MatrixResult result = matrix_of({run_of("voronoi-fv", 0)}, false);
  result.cases[0].scene.material.latent_heat = 0;
  result.cases[0].exact = std::make_shared<Decay>();
  result.runs[0].series.solid_volume.assign(51, std::nan(""));
  result.runs[0].quantities["temperature_l2"] = 0.01;
  EXPECT_EQ(judge_stability(result)[0].verdict, "held");
  result.runs[0].quantities["temperature_l2"] = 0.06;
  EXPECT_EQ(judge_stability(result)[0].reason, "temperature is 0.06, more than 0.05");
}

TEST(Stability, EachBrokenPromiseFailsWithItsReason)
{
  RunRecord leaking = run_of("sph", 0);
  leaking.quantities["budget_defect"] = leaking.checks[1].value = 1e-9;
  EXPECT_EQ(verdict_of(leaking).verdict, "failed");
  EXPECT_NE(verdict_of(leaking).reason.find("heat budget is 1e-09"), std::string::npos);
  leaking.checks[1].value = 1e-15; // what is warm and what is cold sum to nothing
  EXPECT_EQ(verdict_of(leaking).verdict, "held");
  leaking.checks[1].value = 1e-9;
  leaking.cost.steps = 10'000'000; // each rounds
  EXPECT_EQ(verdict_of(leaking).verdict, "held");

  MatrixResult contrasting = matrix_of({leaking});
  contrasting.runs[0].cost.steps = 200;
  EXPECT_EQ(judge_stability(contrasting)[0].verdict, "failed");
  contrasting.cases[0].scene.material.liquid.conductivity = 1e8;
  contrasting.cases[0].scene.material.solid.conductivity = 1;
  EXPECT_EQ(judge_stability(contrasting)[0].verdict, "held") << "fluxes are rounded";

  RunRecord unmeasured = run_of("sph", 0);
  unmeasured.quantities.erase("budget_defect");
  EXPECT_EQ(verdict_of(unmeasured).verdict, "failed");
  EXPECT_EQ(verdict_of(unmeasured).reason, "heat budget is not known");

  RunRecord retreating = run_of("sph", 0);
  retreating.quantities["front_backsteps"] = 1e-6;
  EXPECT_EQ(verdict_of(retreating).verdict, "failed");
  EXPECT_NE(verdict_of(retreating).reason.find("moved back"), std::string::npos);
  MatrixResult allowed = matrix_of({retreating});
  allowed.cases[0].measurement.monotone_front = false;
  EXPECT_EQ(judge_stability(allowed)[0].verdict, "held");

  RunRecord infinite = run_of("sph", 0);
  infinite.series.temperature_max[1] = std::nan("");
  EXPECT_EQ(verdict_of(infinite).verdict, "failed");

  RunRecord hot = run_of("sph", 0);
  hot.checks[0].value = 1e-3;
  EXPECT_EQ(verdict_of(hot).reason, "maximum principle is 0.001, more than 1e-09");

  RunRecord nowhere = run_of("sph", 0);
  nowhere.quantities["front_rms"] = nowhere.quantities["front_end"] = std::nan("");
  EXPECT_EQ(verdict_of(nowhere).reason, "front is not known");
}

TEST(Stability, MethodsThatDoNotConserveHeatAreJudgedByTheHarness)
{
  RunRecord run = run_of("rkpm-tracked", 0);
  run.quantities["budget_defect"] = 1e-2;
  run.checks[1].value = 1e-7;
  EXPECT_EQ(verdict_of(run).reason, "heat budget is 1e-07, more than 1e-12");
  run.checks[1] = {"heat balance", 1e-2, 0.1, true};
  EXPECT_EQ(verdict_of(run).verdict, "held");
  run.checks[1].value = 0.2;
  EXPECT_EQ(verdict_of(run).reason, "heat balance is 0.2, more than 0.1");
}

TEST(Stability, BeyondTheLimitRunsMustBeCaught)
{
  EXPECT_EQ(verdict_of(unguarded(0.5)).verdict, "held");
  EXPECT_EQ(verdict_of(unguarded(1)).verdict, "held");
  RunRecord at_limit = unguarded(1);
  at_limit.quantities["front_backsteps"] = 0.01;
  EXPECT_EQ(verdict_of(at_limit).verdict, "caught");
  EXPECT_EQ(verdict_of(unguarded(1.1)).verdict, "failed") << "however good it looks";
  RunRecord stopped = unguarded(1.1);
  stopped.status = RunStatus::failed;
  stopped.message = "temperature is 1e9 (maximum principle)";
  EXPECT_EQ(verdict_of(stopped).verdict, "caught");
  EXPECT_EQ(verdict_of(stopped).reason, stopped.message);
  stopped.options["step_factor"] = "0.5";
  EXPECT_EQ(verdict_of(stopped).verdict, "failed") << "within the limit";
  stopped.options = {{"step_limit", "monotone"}, {"step_factor", "1.1"}};
  EXPECT_EQ(verdict_of(stopped).verdict, "failed") << "guarded";
}

TEST(Stability, RefusalsNeedAReasonAndFailuresKeepTheirs)
{
  RunRecord run = run_of("sph", 0);
  run.status = RunStatus::refused;
  EXPECT_EQ(verdict_of(run).verdict, "failed");
  run.message = "does not simulate liquid_motion";
  EXPECT_EQ(verdict_of(run).verdict, "refused");
  EXPECT_EQ(verdict_of(run).reason, "does not simulate liquid_motion");
  run.status = RunStatus::failed;
  run.message = "temperature is not finite";
  EXPECT_EQ(verdict_of(run).verdict, "failed");
  EXPECT_EQ(verdict_of(run).reason, "temperature is not finite");
}

TEST(Stability, WithoutAnExactSolutionTheOtherMethodsTell)
{
  const auto verdicts = judge_stability(matrix_of(
      {run_of("sph", 0.001), run_of("fem-enthalpy", 0), run_of("fem-fitted", 0.002),
       run_of("sph-2005", 0.1), run_of("sph", 0.004, 20)},
      false));
  ASSERT_EQ(verdicts.size(), 5u);
  for(const int i : {0, 1, 2, 4})
    EXPECT_EQ(verdicts[i].verdict, "held") << i;
  EXPECT_EQ(verdicts[3].verdict, "failed");
  EXPECT_EQ(verdicts[3].reason,
            "solid off the median of 3 methods is 0.099, more than 0.05");
}

TEST(Stability, OneMethodAloneHasNothingToBeHeldAgainst)
{
  const auto verdicts
      = judge_stability(matrix_of({run_of("sph", 0), run_of("sph", 0, 20)}, false));
  EXPECT_EQ(verdicts[0].verdict, "failed");
  EXPECT_EQ(verdicts[0].reason, "solid off the median of 0 methods is not known");
}

TEST(Stability, WhatIsUnstableHasNoSay)
{
  RunRecord wild = unguarded(2);
  for(double &volume : wild.series.solid_volume)
    volume = 0.9;
  wild.n = 80;
  const auto verdicts = judge_stability(
      matrix_of({run_of("sph", 0), run_of("fem-enthalpy", 0), wild}, false));
  EXPECT_EQ(verdicts[1].verdict, "held");
  EXPECT_EQ(verdicts[2].verdict, "failed");
}

TEST(Stability, OthersTellByTheirMedian)
{
  const std::vector<RunRecord> runs{run_of("a", 0), run_of("b", 0.02), run_of("c", 0.5),
                                    run_of("b", 0.3, 20)};
  std::vector<const RunRecord *> pointers;
  for(const RunRecord &run : runs)
    pointers.push_back(&run);
  const MedianCourse others(pointers);
  EXPECT_EQ(others.others("a"), 2);
  EXPECT_NEAR(others.distance(runs[0]), 0.26, 1e-12); // of 0.02 and 0.5
  EXPECT_NEAR(others.distance(runs[1]), 0.23, 1e-12);
  EXPECT_NEAR(others.course(), 0.2 * 49 / 50, 1e-12);
}
