#include <cases/error.h>
#include <cases/shape.h>

#include <gtest/gtest.h>

#include <vector>

using namespace meltfront::cases;

namespace
{
  /** Area by counting points, and the edge's length as the area of a thin band about it.
   */
  void expect_measures(const Shape &shape, const double side)
  {
    constexpr int n = 1531; // no row of points on a straight edge
    constexpr double band = 0.004;
    const double cell = side / n;
    double area = 0, edge = 0;
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        const double distance
            = shape.signed_distance({(i + 0.5) * cell, (j + 0.5) * cell, 0});
        area += distance > 0 ? cell * cell : 0;
        edge += std::abs(distance) < band ? cell * cell / (2 * band) : 0;
      }
    EXPECT_NEAR(area, shape.volume(), 2e-3 * shape.volume()) << shape.description();
    EXPECT_NEAR(edge, shape.surface(), 1e-2 * shape.surface()) << shape.description();
  }
} // namespace

TEST(Shape, AreaAndEdgeAreThoseOfTheDistance)
{
  expect_measures(Ball(2, {0.5, 0.75, 0}, 0.15), 1);
  expect_measures(SlottedDisk({0.5, 0.75, 0}, 0.15, 0.05, 0.25), 1);
}

TEST(Shape, DistanceFromASlottedDiskIsTheLeastToPointsOnItsEdge)
{
  const double radius = 0.15, half = 0.025, end = 0.1,
               mouth = -std::sqrt(0.0225 - 0.000625);
  const SlottedDisk disk({0, 0, 0}, radius, 0.05, 0.25);
  std::vector<Position> edge;
  const int points = 4000;
  const double begin = -std::numbers::pi / 2 + std::asin(half / radius);
  for(int i = 0; i <= points; ++i)
  {
    const double share = static_cast<double>(i) / points;
    const double angle
        = begin + share * (2 * std::numbers::pi - 2 * std::asin(half / radius));
    edge.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    for(const double sign : {-1., 1.})
      edge.push_back({sign * half, mouth + share * (end - mouth), 0});
    edge.push_back({half * (2 * share - 1), end, 0});
  }
  for(double y = -0.2; y <= 0.2; y += 0.0173)
    for(double x = -0.2; x <= 0.2; x += 0.0131)
    {
      double least = 1;
      for(const Position &p : edge)
        least = std::min(least, std::hypot(p[0] - x, p[1] - y));
      const bool inside = std::hypot(x, y) < radius && !(std::abs(x) < half && y < end);
      EXPECT_NEAR(disk.signed_distance({x, y, 0}), inside ? least : -least, 2e-4)
          << x << ", " << y;
    }
}

TEST(Shape, CurvatureIsOneOverTheRadiusAndTwiceThatInSpace)
{
  EXPECT_DOUBLE_EQ(Ball(2, {}, 0.2).curvature({0.2, 0, 0}), 5);
  EXPECT_DOUBLE_EQ(Ball(3, {}, 0.2).curvature({0.2, 0, 0}), 10);
  const SlottedDisk disk({0.5, 0.75, 0}, 0.15, 0.05, 0.25);
  EXPECT_DOUBLE_EQ(disk.curvature({0.65, 0.75, 0}), 1 / 0.15);
  EXPECT_TRUE(std::isnan(disk.curvature({0.525, 0.7, 0})));
  EXPECT_EQ(HalfSpace(0.5).signed_distance({0.2, 3, 4}), 0.3);
}

TEST(Shape, RefusesWhatIsNone)
{
  EXPECT_THROW(Ball(2, {}, 0), Refusal);
  EXPECT_THROW(SlottedDisk({}, 0.1, 0.3, 0.1), Refusal);
  EXPECT_THROW(SlottedDisk({}, 0.1, 0.05, 0.3), Refusal);
}
