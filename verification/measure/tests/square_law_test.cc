#include <verification/measure/formulas/square_law.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace meltfront::verification
{
  namespace
  {
    TEST(SquareLaw, FindsTheSlopeOfASimilarFrontBehindItsStart)
    {
      std::vector<double> time, front;
      for(int i = 0; i <= 100; ++i)
      {
        time.push_back(0.1 * i);
        front.push_back(i < 5 ? 0 : std::sqrt(0.7 * time.back() + 0.2));
      }
      const SquareLaw law = square_law(time, front, 1);
      EXPECT_NEAR(law.slope, 0.7, 1e-12);
      EXPECT_NEAR(law.r_squared, 1, 1e-12);
      EXPECT_NEAR(law.largest_error, 0, 1e-12);
      EXPECT_EQ(law.points, 101 - 12); // 0.7 t + 0.2 >= 1 from t = 1.2 on
    }

    TEST(SquareLaw, SaysHowFarAFrontIsFromTheLaw)
    {
      std::vector<double> time, front;
      for(int i = 0; i <= 100; ++i)
      {
        time.push_back(i);
        front.push_back(i); // in proportion to time: the square is a parabola
      }
      const SquareLaw law = square_law(time, front, 0);
      EXPECT_NEAR(law.slope, 100, 1e-9);
      EXPECT_LT(law.r_squared, 0.95);
      EXPECT_GT(law.largest_error, 0.1);
    }

    TEST(SquareLaw, IsNotANumberForAFrontThatNeverCameSoFar)
    {
      const std::vector<double> time(50, 1), front(50, 0.5);
      EXPECT_TRUE(std::isnan(square_law(time, front, 1).slope));
      const std::vector<double> none(50, std::numeric_limits<double>::quiet_NaN());
      EXPECT_TRUE(std::isnan(square_law(time, none, 0).slope));
    }
  } // namespace
} // namespace meltfront::verification
