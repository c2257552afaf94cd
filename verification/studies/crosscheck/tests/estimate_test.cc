#include <verification/studies/crosscheck/estimate.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr std::size_t times = 25;

    /** Values 1 + factor h^order. */
    CourseLevel level(int n, double factor, double order)
    {
      const double h = 1. / n;
      return {h, std::vector<double>(times, 1 + factor * std::pow(h, order))};
    }

    TEST(Estimate, HoldsTheTruthOfFirstOrderAtTheSafetyFactor)
    {
      const Estimate estimate
          = estimate_at({level(20, 3, 1), level(40, 3, 1), level(80, 3, 1)}, 24, 0);
      EXPECT_NEAR(estimate.order, 1, 1e-6);
      const double error = 3. / 80;
      EXPECT_NEAR(estimate.bar, safety_factor * error, 1e-6 * error);
      EXPECT_TRUE(estimate.converging);
    }

    TEST(Estimate, TakesNoOrderBeyondTheHighest)
    {
      const Estimate estimate
          = estimate_at({level(20, 3, 4), level(40, 3, 4), level(80, 3, 4)}, 24, 0);
      EXPECT_DOUBLE_EQ(estimate.order, highest_order);
      EXPECT_GT(estimate.bar, safety_factor * 3 * std::pow(80, -4.));
    }

    TEST(Estimate, EqualEndValuesAreNoConvergenceWhereTheCourseDiffers)
    {
      std::vector<CourseLevel> levels{level(20, 0, 1), level(40, 0, 1), level(80, 0, 1)};
      for(std::size_t k = 0; k + 1 < times; ++k)
        for(std::size_t i = 0; i < levels.size(); ++i)
          levels[i].values[k] += (k % 2 == 0 ? 1 : -1) * 0.4 * levels[i].spacing;
      const Estimate estimate = estimate_at(levels, 24, 0);
      EXPECT_DOUBLE_EQ(estimate.value, 1);
      EXPECT_GT(estimate.bar, 0.2 / 80);
    }

    TEST(Estimate, LevelsThatDoNotConvergeGiveThreeTimesTheirDifference)
    {
      std::vector<CourseLevel> levels{level(20, 0, 1), level(40, 0, 1), level(80, 0, 1)};
      for(double &value : levels[2].values)
        value += 0.1;
      levels[0].values.assign(times, 1.02);
      const Estimate estimate = estimate_at(levels, 12, 1);
      EXPECT_FALSE(estimate.converging);
      EXPECT_NEAR(estimate.bar, 0.3 + reading_error, 1e-12);
    }

    TEST(Estimate, OneLevelKnowsNothingOfItsErrorTwoTakeALowOrder)
    {
      EXPECT_TRUE(std::isinf(estimate_at({level(20, 3, 1)}, 24, 0).bar));
      const Estimate estimate = estimate_at({level(20, 3, 1), level(40, 3, 1)}, 24, 0);
      const double difference = 3. / 40;
      EXPECT_NEAR(estimate.bar,
                  safety_factor * difference / (std::pow(2, order_of_two_levels) - 1),
                  1e-12);
    }

    TEST(Estimate, TwoLevelsThatAgreeAtTheEndAloneAreNotBelieved)
    {
      // a h + b h^2 with a h_1 + b h_1^2 = a h_2 + b h_2^2 at the end, far from the
      // truth.
      std::vector<CourseLevel> levels{level(20, 0, 1), level(34, 0, 1)};
      for(CourseLevel &of : levels)
        for(std::size_t k = 0; k < times; ++k)
        {
          const double early = 1 - k / (times - 1.), h = of.spacing;
          of.values[k] += 0.05 * h + (0.05 * early - 0.05) * h * h / (1. / 20 + 1. / 34);
        }
      const Estimate estimate = estimate_at(levels, times - 1, 0);
      ASSERT_NEAR(levels[0].values.back(), levels[1].values.back(), 1e-15);
      EXPECT_GT(estimate.bar, std::abs(estimate.value - 1));
      levels.push_back(level(54, 0.05, 1));
      EXPECT_LT(estimate_at(levels, times - 1, 0).bar, estimate.bar);
    }

    TEST(Estimate, FinestOfFiveLevelsCount)
    {
      // The coarsest lies before the range in which errors fall as they should.
      const std::vector<CourseLevel> finest{level(40, 3, 2), level(80, 3, 2),
                                            level(160, 3, 2), level(320, 3, 2)};
      std::vector<CourseLevel> all{level(20, 90, 0)};
      all.insert(all.end(), finest.begin(), finest.end());
      EXPECT_DOUBLE_EQ(estimate_at(all, 6, 1).bar, estimate_at(finest, 6, 1).bar);
    }

    TEST(Estimate, LevelsThatFellInALeapAreNotBelievedBecauseTheFinestAgree)
    {
      const std::vector<CourseLevel> finest{level(80, 0, 1), level(160, 0, 1),
                                            level(320, 0, 1)};
      std::vector<CourseLevel> all{level(40, 3, 1)};
      all.insert(all.end(), finest.begin(), finest.end());
      EXPECT_GT(estimate_at(all, 6, 1).bar, 20 * estimate_at(finest, 6, 1).bar);
    }
  } // namespace
} // namespace meltfront::verification
