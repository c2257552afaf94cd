#include <verification/matrix/progress.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    RunKind kind(const std::string &label, int n, const std::string &case_name = "slab")
    {
      return {case_name, label, label.substr(0, label.find('[')), n};
    }

    TEST(TimeEstimate, FollowsTheMeasuredTimesOfTheSameLabel)
    {
      TimeEstimate estimate;
      EXPECT_TRUE(std::isnan(estimate.seconds(kind("fem", 10))));
      estimate.add(kind("fem", 100), 10);
      EXPECT_NEAR(estimate.seconds(kind("fem", 50)), 2.5, 1e-12) << "n squared";
      estimate.add(kind("fem", 50), 5);
      EXPECT_NEAR(estimate.seconds(kind("fem", 25)), 2.5, 1e-12) << "first power of n";
      EXPECT_NEAR(estimate.seconds(kind("fem", 200)), 20, 1e-12);
      // A finer run that was quicker says nothing of coarser ones being slower.
      estimate.add(kind("odd", 100), 1);
      estimate.add(kind("odd", 50), 2);
      EXPECT_NEAR(estimate.seconds(kind("odd", 25)), 2, 1e-12);
    }

    TEST(TimeEstimate, FallsBackToTheMethodAndThenToAll)
    {
      TimeEstimate estimate;
      estimate.add(kind("fem[a=1]", 10), 1);
      estimate.add(kind("fem[a=2]", 10, "disk"), 3);
      estimate.add(kind("sph", 10), 80);
      EXPECT_NEAR(estimate.seconds(kind("fem[a=3]", 20)), 8, 1e-12);
      EXPECT_NEAR(estimate.seconds(kind("other", 10)), 28, 1e-12);
    }

    TEST(TimeEstimate, ScalesWhatRunsTookAnotherTime)
    {
      TimeEstimate estimate;
      estimate.expect(kind("fem", 100), 10);
      estimate.expect(kind("sph", 50), 6);
      EXPECT_NEAR(estimate.seconds(kind("sph", 50)), 6, 1e-12);
      // This machine takes half as long.
      estimate.add(kind("fem", 100), 5);
      EXPECT_NEAR(estimate.seconds(kind("sph", 50)), 3, 1e-12);
      EXPECT_NEAR(estimate.seconds(kind("fem", 200)), 20, 1e-12) << "not expected";
    }

    TEST(Progress, AddsUpWhatIsLeftOverItsJobs)
    {
      std::vector<RunKind> runs;
      for(const int n : {10, 20, 40, 40})
        runs.push_back(kind("fem", n, n == 40 ? "disk" : "slab"));
      runs.back().label = "fem[a=1]";
      Progress progress(nullptr, runs, 0, 2);
      EXPECT_TRUE(std::isnan(progress.seconds_left()));
      progress.run_ended(runs[0], 1, "", "", true);
      EXPECT_NEAR(progress.seconds_left(), (4 + 16 + 16) / 2., 1e-12);
      progress.run_ended(runs[2], 64, "", "", true);
      // The mean of 1/100 and 64/1600 of the method's runs.
      EXPECT_NEAR(progress.seconds_left(), std::max((4 + 40) / 2., 40.), 1e-12);
    }
  } // namespace
} // namespace meltfront::verification
