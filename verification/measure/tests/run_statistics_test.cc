#include <verification/measure/formulas/order_fit.h>
#include <verification/measure/formulas/run_statistics.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    double cubic(double t)
    {
      return 2 - 3 * t + 0.5 * t * t + 4 * t * t * t;
    }

    TEST(Interpolated, IsExactForACubicOnUnequalTimes)
    {
      const std::vector<double> times{0, 0.1, 0.35, 0.4, 0.8, 1};
      std::vector<double> values;
      for(const double t : times)
        values.push_back(cubic(t));
      for(const double t : {0., 0.03, 0.2, 0.36, 0.5, 0.9, 0.97, 1.})
        EXPECT_NEAR(interpolated(times, values, t), cubic(t), 1e-13) << t;
    }

    TEST(Interpolated, TakesASampleThatLiesAtTheTime)
    {
      const std::vector<double> times{0, 1, 2, 3}, values{0, 7, -5, 1};
      EXPECT_EQ(interpolated(times, values, 1), 7);
      EXPECT_EQ(interpolated(times, values, 2 + 1e-10, 1e-9), -5);
      EXPECT_EQ(interpolated(times, values, 3 + 1e-10, 1e-9), 1);
      EXPECT_NE(interpolated(times, values, 2 + 1e-10), -5);
    }

    TEST(Interpolated, IsNaNOutsideAndOfLowerDegreeWithFewSamples)
    {
      EXPECT_TRUE(std::isnan(interpolated({}, {}, 0)));
      EXPECT_TRUE(std::isnan(interpolated({0, 1}, {0, 1}, 1.1)));
      EXPECT_TRUE(std::isnan(interpolated({0, 1}, {0, 1}, -0.1)));
      EXPECT_TRUE(std::isnan(interpolated({0, 1}, {0, 1}, std::nan(""))));
      EXPECT_DOUBLE_EQ(interpolated({0, 1}, {0, 2}, 0.25), 0.5);
      EXPECT_DOUBLE_EQ(interpolated({0, 1, 2}, {0, 1, 4}, 1.5), 2.25);
    }

    TEST(Interpolated, IsOfFourthOrderForASmoothCourse)
    {
      std::vector<double> steps, errors;
      for(const int n : {8, 16, 32, 64, 128})
      {
        std::vector<double> times, values;
        for(int i = 0; i <= n; ++i)
        {
          times.push_back(static_cast<double>(i) / n);
          values.push_back(std::sin(3 * times.back()));
        }
        double worst = 0;
        for(int i = 0; i < n; ++i)
        {
          const double t = (i + 0.5) / n;
          worst = std::max(worst,
                           std::abs(interpolated(times, values, t) - std::sin(3 * t)));
        }
        steps.push_back(1. / n);
        errors.push_back(worst);
      }
      EXPECT_GT(fit_order(steps, errors, 4.5).order, 3.7);
    }

    TEST(SnapshotTimes, WantsTheStepsAroundATime)
    {
      SnapshotTimes watch({0.5});
      std::vector<int> wanted;
      for(int step = 0; step <= 100; ++step)
      {
        watch.pass(step, step / 100.);
        watch.pass(step, step / 100.); // asked again of the same step
        if(watch.near_one())
          wanted.push_back(step);
      }
      ASSERT_FALSE(wanted.empty());
      EXPECT_LE(wanted.front(), 48);
      EXPECT_GE(wanted.back(), 52);
      EXPECT_LE(wanted.size(), 12u) << "snapshots are not free";
      SnapshotTimes none({});
      none.pass(0, 0);
      none.pass(1, 0.1);
      EXPECT_FALSE(none.near_one());
    }

    TEST(FrontCourse, KnowsBothDirections)
    {
      FrontCourse course;
      EXPECT_TRUE(std::isnan(course.largest_backstep(false)));
      for(const double position : {1., 3., 2.5, 5., 4.})
        course.add(position);
      EXPECT_EQ(course.net_advance(), 3);
      EXPECT_EQ(course.largest_backstep(false), 1);
      EXPECT_EQ(course.largest_backstep(true), 4);
    }
  } // namespace
} // namespace meltfront::verification
