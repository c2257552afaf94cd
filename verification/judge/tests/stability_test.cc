#include <verification/judge/stability.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::verification;

namespace
{
  /** A case on a unit slab with one run that held. */
  MatrixResult one_good_run()
  {
    MatrixResult result;
    result.hard_cases = true;
    StoredCase record;
    record.scene.name = "hard";
    record.scene.domain.upper = {1, 0, 0};
    result.cases = {record};
    RunRecord run;
    run.case_name = "hard";
    run.label = "method";
    run.n = 40;
    run.status = RunStatus::finished;
    run.series.time = {0, 1};
    run.series.front = {0, 0.2};
    run.series.temperature_min = {0, 0};
    run.series.temperature_max = {1, 1};
    run.quantities = {{"budget_defect", 1e-15}, {"front_backsteps", 0.}};
    result.runs = {run};
    return result;
  }

  StabilityVerdict verdict_of(const MatrixResult &result)
  {
    const auto verdicts = judge_stability(result);
    EXPECT_EQ(verdicts.size(), 1u);
    return verdicts.at(0);
  }
} // namespace

TEST(Stability, AFiniteConservingMonotoneRunHolds)
{
  const StabilityVerdict verdict = verdict_of(one_good_run());
  EXPECT_EQ(verdict.verdict, "held");
  EXPECT_EQ(verdict.reason, "");
  EXPECT_EQ(verdict.n, 40);
}

TEST(Stability, EachBrokenPromiseFailsWithItsReason)
{
  MatrixResult leaking = one_good_run();
  leaking.runs[0].quantities["budget_defect"] = 1e-9;
  EXPECT_EQ(verdict_of(leaking).verdict, "failed");
  EXPECT_NE(verdict_of(leaking).reason.find("heat budget"), std::string::npos);

  MatrixResult unmeasured = one_good_run();
  unmeasured.runs[0].quantities.erase("budget_defect");
  EXPECT_EQ(verdict_of(unmeasured).verdict, "failed");

  MatrixResult retreating = one_good_run();
  retreating.runs[0].quantities["front_backsteps"] = 1e-6;
  EXPECT_EQ(verdict_of(retreating).verdict, "failed");
  EXPECT_NE(verdict_of(retreating).reason.find("moved back"), std::string::npos);
  retreating.cases[0].measurement.monotone_front = false;
  EXPECT_EQ(verdict_of(retreating).verdict, "held");

  MatrixResult infinite = one_good_run();
  infinite.runs[0].series.temperature_max[1] = std::nan("");
  EXPECT_EQ(verdict_of(infinite).verdict, "failed");
}

TEST(Stability, AResultBeyondTheStabilityLimitHasFailed)
{
  MatrixResult result = one_good_run();
  result.runs[0].options["step_factor"] = "1.1";
  EXPECT_EQ(verdict_of(result).verdict, "failed");
  result.runs[0].options["step_factor"] = "0.9";
  EXPECT_EQ(verdict_of(result).verdict, "held");
  result.runs[0].options["step_factor"] = "1.1";
  result.runs[0].status = RunStatus::refused;
  result.runs[0].message = "the step is beyond the limit";
  EXPECT_EQ(verdict_of(result).verdict, "refused");
  result.runs[0].status = RunStatus::failed;
  result.runs[0].message = "temperature is not finite";
  EXPECT_EQ(verdict_of(result).verdict, "refused") << "caught, not returned";
}

TEST(Stability, RefusalsNeedAReasonAndFailuresKeepTheirs)
{
  MatrixResult result = one_good_run();
  result.runs[0].status = RunStatus::refused;
  EXPECT_EQ(verdict_of(result).verdict, "failed");
  result.runs[0].message = "does not simulate liquid_motion";
  EXPECT_EQ(verdict_of(result).verdict, "refused");
  EXPECT_EQ(verdict_of(result).reason, "does not simulate liquid_motion");
  result.runs[0].status = RunStatus::failed;
  result.runs[0].message = "temperature is not finite";
  EXPECT_EQ(verdict_of(result).verdict, "failed");
  EXPECT_EQ(verdict_of(result).reason, "temperature is not finite");
}
