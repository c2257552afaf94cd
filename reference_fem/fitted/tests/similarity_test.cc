#include <cases/error.h>
#include <reference_fem/fitted/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::fitted::tests
{
  namespace
  {
    using namespace reference_fem::tests;

    /** Roundings of the solver, far above those of sums and far below any error. */
    constexpr double balance = 1e-12;

    constexpr long target_iterations = 6;

    Record run(const ExactScene &scene, int n, const OptionTexts &options = {},
               double temperature_from = 0)
    {
      return tests::run(scene.scene, n, options, scene.exact.get(), temperature_from);
    }

    TEST(FemFitted, FollowsAPlaneFrontToTenDigits)
    {
      const Record record = run(started_slab(), 32);
      EXPECT_LT(record.final_front_error(), 1e-10);
      EXPECT_LT(record.worst_front_error(), 1e-8);
      EXPECT_LT(record.temperature_error, 1e-9);
      EXPECT_LT(record.worst_budget_defect(), balance);
      EXPECT_LE(record.cost.most_iterations, target_iterations);
    }

    TEST(FemFitted, TheFrontConvergesAtTwiceTheDegree)
    {
      // Up to where rounding sets in; the time error is far below.
      const std::vector<int> levels{8, 16, 32, 64};
      for(const int degree : {1, 2, 3})
      {
        std::vector<double> errors;
        for(const int n : levels)
          errors.push_back(run(started_slab(), n,
                               {{"degree", std::to_string(degree)}, {"refine", "space"}})
                               .final_front_error());
        EXPECT_GT(fitted_order(levels, errors), 2 * degree - 0.5) << degree;
      }
    }

    TEST(FemFitted, TimeSchemesHaveTheirOrders)
    {
      const std::vector<int> levels{20, 40, 80, 160};
      for(const auto &[scheme, order] : std::map<std::string, double>{
              {"bdf2", 2}, {"bdf3", 3}, {"bdf4", 4}, {"radau3", 3}})
      {
        std::vector<double> errors;
        for(const int n : levels)
          errors.push_back(
              run(started_slab(), n,
                  {{"time_scheme", scheme}, {"refine", "time"}, {"cells", "64"}})
                  .final_front_error());
        EXPECT_GT(fitted_order(levels, errors), order - 0.2) << scheme;
      }
    }

    TEST(FemFitted, LighterIcePushesWaterOut)
    {
      const Record record = run(lighter_ice(), 32);
      EXPECT_LT(record.final_front_error(), 1e-8);
      EXPECT_LT(record.worst_front_error(), 1e-8);
      EXPECT_LT(record.worst_budget_defect(), balance);
    }

    TEST(FemFitted, SplitsOffTheFieldOfALineSink)
    {
      const Record record = run(line_sink_disk(), 64, {}, 0.06);
      EXPECT_LT(record.final_front_error(), 1e-9);
      EXPECT_LT(record.worst_front_error(), 1e-9);
      EXPECT_LT(record.temperature_error, 1e-8);
      EXPECT_LT(record.worst_budget_defect(), balance);
    }

    TEST(FemFitted, SplitsOffTheFieldOfAPointSinkThatGrows)
    {
      const Record record = run(point_sink_ball(), 64, {}, 0.06);
      EXPECT_LT(record.final_front_error(), 1e-9);
      EXPECT_LT(record.worst_front_error(), 1e-8);
      EXPECT_LT(record.temperature_error, 1e-8);
      EXPECT_LT(record.worst_budget_defect(), balance);
    }

    TEST(FemFitted, FollowsUndercooledGrowth)
    {
      for(const int dimension : {2, 3})
      {
        const Record record = run(frank(dimension), 64);
        EXPECT_LT(record.final_front_error(), 1e-8) << dimension;
        EXPECT_LT(record.worst_front_error(), 1e-8) << dimension;
        EXPECT_LT(record.worst_budget_defect(), balance) << dimension;
      }
    }

    TEST(FemFitted, SolvesRadialScenesInThePlaneAsAlongARadius)
    {
      // Exact circles and equal cells around: nothing depends on the angle.
      const Record line = run(line_sink_disk(), 16, {}, 0.06);
      const Record plane
          = run(line_sink_disk(), 16, {{"dimension", "2"}, {"cells_around", "4"}}, 0.06);
      EXPECT_LT(plane.final_front_error(), 1e-7);
      EXPECT_NEAR(plane.front.back(), line.front.back(), 1e-12);
      EXPECT_NEAR(plane.temperature_error, line.temperature_error, 1e-10);
      EXPECT_LT(plane.worst_budget_defect(), balance);
    }

    TEST(FemFitted, SolvesRadialScenesInSpaceAsAlongARadius)
    {
      const OptionTexts space{{"dimension", "3"}, {"cells_around", "4"}, {"degree", "2"}};
      const Record line = run(frank(3), 8, {{"degree", "2"}});
      const Record ball = run(frank(3), 8, space);
      double worst = 0;
      for(std::size_t i = 0; i < ball.front_points[0].size(); ++i)
        worst = std::max(
            worst, std::abs(std::hypot(ball.front_points[0][i], ball.front_points[1][i],
                                       ball.front_points[2][i])
                            - line.front.back()));
      EXPECT_LT(worst, 1e-11);
      EXPECT_LT(ball.worst_budget_defect(), balance);
    }
  } // namespace
} // namespace meltfront::reference_fem::fitted::tests
