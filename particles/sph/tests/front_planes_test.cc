#include <particles/sph/front_planes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** Part of the unit square behind a line, by points on a fine grid. */
    double part_behind(double distance, double x, double y)
    {
      constexpr int points = 400;
      int behind = 0;
      for(int i = 0; i < points; ++i)
        for(int j = 0; j < points; ++j)
          behind += ((i + 0.5) / points - 0.5) * x + ((j + 0.5) / points - 0.5) * y
                    < distance;
      return double(behind) / (points * points);
    }

    TEST(FrontPlanes, LineLeavesTheGivenPartBehind)
    {
      for(const double angle : {0., 0.2, 0.7853981633974483, 1.3, 2.5, 4.})
        for(const double part : {0.02, 0.3, 0.5, 0.9, 0.99})
        {
          const double x = std::cos(angle), y = std::sin(angle);
          EXPECT_NEAR(part_behind(line_through_square(part, x, y), x, y), part, 3e-3)
              << "angle " << angle << ", part " << part;
        }
    }

    TEST(FrontPlanes, LineOfNoPartTouchesTheCorner)
    {
      EXPECT_DOUBLE_EQ(line_through_square(0, 0.6, 0.8), -0.7);
      EXPECT_DOUBLE_EQ(line_through_square(1, -0.6, 0.8), 0.7);
    }
  } // namespace
} // namespace meltfront::particles
