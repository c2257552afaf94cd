#include <cases/error.h>
#include <verification/measure/formulas/grid_convergence.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace meltfront::verification
{
  namespace
  {
    double value_at(double h, double order)
    {
      return 0.3 - 2 * std::pow(h, order);
    }

    TEST(GridConvergence, FindsOrderAndLimitOfAPowerLaw)
    {
      for(const double order : {0.5, 1., 1.5, 2., 4.})
      {
        const std::vector<double> h{0.1, 0.04, 0.02}; // unequal ratios
        std::vector<double> values;
        for(const double resolution : h)
          values.push_back(value_at(resolution, order));
        const GridConvergence result = extrapolate(h, values);
        EXPECT_TRUE(result.monotone);
        EXPECT_NEAR(result.order, order, 1e-7);
        EXPECT_NEAR(result.extrapolated, 0.3, 1e-9);
        EXPECT_NEAR(result.uncertainty, 1.25 * 2 * std::pow(0.02, order), 1e-8);
      }
    }

    TEST(GridConvergence, UsesTheThreeFinestLevels)
    {
      const std::vector<double> h{0.4, 0.025, 0.1, 0.05};
      std::vector<double> values;
      for(const double resolution : h)
        values.push_back(resolution > 0.3 ? 77 : value_at(resolution, 2));
      EXPECT_NEAR(extrapolate(h, values).extrapolated, 0.3, 1e-12);
    }

    TEST(GridConvergence, HasNoLimitForValuesThatTurnOrRunAway)
    {
      const std::vector<double> h{0.4, 0.2, 0.1};
      for(const std::vector<double> &values :
          {std::vector{1., 2., 1.5}, std::vector{1., 2., 4.}, std::vector{1., 2., 3.}})
      {
        const GridConvergence result = extrapolate(h, values);
        EXPECT_FALSE(result.monotone);
        EXPECT_TRUE(std::isnan(result.extrapolated));
        const double spread = *std::max_element(values.begin(), values.end())
                              - *std::min_element(values.begin(), values.end());
        EXPECT_DOUBLE_EQ(result.uncertainty, 3 * spread);
      }
    }

    TEST(GridConvergence, KnowsEqualValuesAndNaN)
    {
      const std::vector<double> h{0.4, 0.2, 0.1};
      EXPECT_EQ(extrapolate(h, std::vector{2., 2., 2.}).extrapolated, 2);
      EXPECT_EQ(extrapolate(h, std::vector{2., 2., 2.}).uncertainty, 0);
      EXPECT_TRUE(
          std::isnan(extrapolate(h, std::vector{2., std::nan(""), 3.}).uncertainty));
      EXPECT_THROW(extrapolate(std::vector{0.4, 0.2}, std::vector{1., 2.}),
                   cases::InputError);
      EXPECT_THROW(extrapolate(std::vector{0.4, 0.2, 0.2}, std::vector{1., 2., 3.}),
                   cases::InputError);
    }
  } // namespace
} // namespace meltfront::verification
