#include <cases/error.h>
#include <cases/outline.h>
#include <cases/scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

using namespace meltfront::cases;

namespace
{
  using Point = Outline::Point;
  constexpr double pi = std::numbers::pi;

  /** An L: the unit square without its upper right quarter. */
  const std::vector<Point> angle_iron{{0, 0},     {1, 0},   {1, 0.5},
                                      {0.5, 0.5}, {0.5, 1}, {0, 1}};

  double cavity_radius(double phi)
  {
    return 0.42
           * (1 + 0.18 * std::cos(2 * phi) + 0.12 * std::sin(phi)
              - 0.08 * std::sin(3 * phi));
  }

  std::string complaint(const std::function<void()> &make)
  {
    try
    {
      make();
    }
    catch(const InputError &error)
    {
      return error.what();
    }
    return "no complaint";
  }

  std::string complaint(const std::vector<Point> &corners)
  {
    return complaint([&] { Outline outline(corners); });
  }

  bool says(const std::string &message, const std::string &piece)
  {
    return message.find(piece) != std::string::npos;
  }
} // namespace

TEST(Outline, PolygonsAreExact)
{
  for(const bool reversed : {false, true})
  {
    std::vector<Point> corners = angle_iron;
    if(reversed)
      std::reverse(corners.begin(), corners.end());
    const Outline outline(corners);
    EXPECT_DOUBLE_EQ(outline.area(), 0.75);
    EXPECT_DOUBLE_EQ(outline.perimeter(), 4);
    EXPECT_EQ(outline.lower(), (Point{0, 0}));
    EXPECT_EQ(outline.upper(), (Point{1, 1}));
    EXPECT_TRUE(outline.inside({0.25, 0.75, 0}));
    EXPECT_TRUE(outline.inside({0.75, 0.25, 0}));
    EXPECT_FALSE(outline.inside({0.75, 0.75, 0}));
    EXPECT_FALSE(outline.inside({-1, 0.5, 0})) << "left of it, at the height of a corner";
    EXPECT_FALSE(outline.inside({2, 0.5, 0}));
    EXPECT_DOUBLE_EQ(outline.distance({0.25, 0.25, 0}), 0.25);
    EXPECT_DOUBLE_EQ(outline.distance({0.8, 0.9, 0}), 0.3);
    EXPECT_DOUBLE_EQ(outline.distance({0.5 - 0.03, 0.5 - 0.04, 0}), 0.05)
        << "from the corner that points inwards";
    EXPECT_EQ(outline.nearest({0.25, 2, 0}), (Position{0.25, 1, 0}));
    EXPECT_EQ(outline.nearest({3, -1, 0}), (Position{1, 0, 0}));
    EXPECT_EQ(outline.corner_arc_lengths().size(), 6u);
  }
}

TEST(Outline, LinesCrossPolygonsOrAreHiddenByThem)
{
  const Outline outline(angle_iron);
  const Position below{0.75, 0.25, 0}, left{0.25, 0.75, 0}, deep{0.25, 0.25, 0};
  EXPECT_FALSE(outline.hides(below, left)) << "the line touches the inner corner";
  EXPECT_FALSE(outline.hides(left, below));
  EXPECT_FALSE(outline.hides(below, deep));
  EXPECT_TRUE(outline.hides({0.75, 0.26, 0}, left));
  EXPECT_TRUE(outline.hides(left, {0.75, 0.26, 0}));

  const auto out = outline.first_crossing(below, {0.75, 3, 0});
  ASSERT_TRUE(out);
  EXPECT_DOUBLE_EQ(out->place[1], 0.5);
  EXPECT_EQ(out->normal, (Point{0, 1}));
  const auto first = outline.first_crossing({0.25, 0.8, 0}, {0.75, 0.3, 0});
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->place[0], 0.5, 1e-15);
  EXPECT_NEAR(first->place[1], 0.55, 1e-15);
  EXPECT_EQ(first->normal, (Point{1, 0})) << "where it leaves, not where it comes back";
  EXPECT_FALSE(outline.first_crossing(below, deep));
  EXPECT_TRUE(outline.first_crossing(below, {1.75, 1.25, 0}));
  const Outline::Edge nearest = outline.nearest_edge({0.3, -2, 0});
  EXPECT_EQ(nearest.place, (Position{0.3, 0, 0}));
  EXPECT_EQ(nearest.normal, (Point{0, -1}));
}

TEST(Outline, LinesCrossCurvesAtTheirRadius)
{
  const Outline disk([](double) { return 2.; }, Point{1, -1});
  for(const double angle : {0.1, 1.3, 2.9, -2.2})
  {
    const Point direction{std::cos(angle), std::sin(angle)};
    const auto edge = disk.first_crossing(
        {1, -1, 0}, {1 + 5 * direction[0], -1 + 5 * direction[1], 0});
    ASSERT_TRUE(edge);
    EXPECT_NEAR(std::hypot(edge->place[0] - 1, edge->place[1] + 1), 2, 1e-6);
    EXPECT_NEAR(edge->normal[0] * direction[0] + edge->normal[1] * direction[1], 1, 1e-5);
  }
}

TEST(Outline, AreaOfATurnedAndShiftedPolygonStays)
{
  std::vector<Point> corners;
  for(const auto &[x, y] : angle_iron)
    corners.push_back({7 + x * std::cos(0.3) - y * std::sin(0.3),
                       -5 + x * std::sin(0.3) + y * std::cos(0.3)});
  const Outline outline(corners);
  EXPECT_NEAR(outline.area(), 0.75, 1e-14);
  EXPECT_NEAR(outline.perimeter(), 4, 1e-14);
}

TEST(Outline, LengthAlongItGoesRound)
{
  const Outline outline(angle_iron);
  EXPECT_EQ(outline.at(0), (Position{0, 0, 0}));
  EXPECT_EQ(outline.at(1.25), (Position{1, 0.25, 0}));
  EXPECT_EQ(outline.at(1.25 - 4), (Position{1, 0.25, 0}));
  EXPECT_EQ(outline.at(4 + 3.5), (Position{0, 0.5, 0}));
  for(const double s : {0.1, 0.9, 1.1, 1.7, 2.2, 2.8, 3.3, 3.9})
    EXPECT_NEAR(outline.arc_length_at(outline.at(s)), s, 1e-15);
  const std::vector<Position> points = outline.points(16);
  EXPECT_EQ(points.size(), 16u);
  EXPECT_EQ(points[5], (Position{1, 0.25, 0}));
}

TEST(Outline, WhatIsNoPolygonIsRefused)
{
  EXPECT_TRUE(says(complaint({{0, 0}, {1, 0}}), "three at least"));
  EXPECT_TRUE(says(complaint({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), "crosses"));
  EXPECT_TRUE(says(complaint({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "twice in a row"));
  EXPECT_TRUE(says(complaint({{0, 0}, {1, 0}, {0, 1}, {0, 0}}), "twice in a row"));
  EXPECT_TRUE(says(complaint({{0, 0}, {2, 0}, {1, 0}, {0, 1}}), "turns back"));
  EXPECT_TRUE(says(complaint({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}), "touches"));
  EXPECT_TRUE(says(complaint({{0, 0}, {1, std::nan("")}, {0, 1}}), "not finite"));
  EXPECT_EQ(complaint(angle_iron), "no complaint");
}

TEST(Outline, AreaAndPerimeterOfPolarCurves)
{
  const Outline circle([](double) { return 0.3; }, {1, 2});
  EXPECT_NEAR(circle.area(), pi * 0.09, 2e-13);
  EXPECT_NEAR(circle.perimeter(), 0.6 * pi, 1e-13);
  // pi r0^2 (1 + half the sum of the squared amplitudes)
  const Outline cavity(cavity_radius, {0, 0});
  const double squares = 0.18 * 0.18 + 0.12 * 0.12 + 0.08 * 0.08;
  EXPECT_NEAR(cavity.area(), pi * 0.42 * 0.42 * (1 + squares / 2), 2e-13);
  EXPECT_NEAR(cavity.area(), 0.568918050806, 5e-13);
  // A square, whose radius has kinks.
  const Outline square(
      [](double phi)
      { return 1 / std::max(std::abs(std::cos(phi)), std::abs(std::sin(phi))); },
      {0, 0});
  EXPECT_NEAR(square.area(), 4, 1e-12);
  EXPECT_NEAR(square.perimeter(), 8, 1e-12);
}

TEST(Outline, PointsOfPolarCurves)
{
  const Outline cavity(cavity_radius, {0, 0});
  EXPECT_NEAR(cavity.upper()[1], 0.42 * (1 - 0.18 + 0.12 + 0.08), 1e-7);
  for(const Position &p : cavity.points(37))
  {
    const double r = std::hypot(p[0], p[1]);
    EXPECT_NEAR(r, cavity_radius(std::atan2(p[1], p[0])), 1e-15);
    for(const double share : {0.999, 1.001})
    {
      const Position near{share * p[0], share * p[1], 0};
      EXPECT_EQ(cavity.inside(near), share < 1);
      EXPECT_LE(cavity.distance(near), 0.001 * r * (1 + 1e-6));
    }
  }
  const Outline circle([](double) { return 0.5; }, {0.1, 0.2});
  for(const double phi : {-3., -1., 0.2, 2.9})
  {
    const Position p{0.1 + 0.2 * std::cos(phi), 0.2 + 0.2 * std::sin(phi), 0};
    EXPECT_NEAR(circle.distance(p), 0.3, 1e-15);
    EXPECT_NEAR(circle.nearest(p)[0], 0.1 + 0.5 * std::cos(phi), 1e-9);
    EXPECT_NEAR(circle.at(circle.arc_length_at(p))[0], circle.nearest(p)[0], 1e-15);
  }
}

TEST(Outline, RadiiThatCloseNoCurveAreRefused)
{
  const auto polar = [](std::function<double(double)> radius) {
    return complaint([&] { Outline outline(radius, {0, 0}); });
  };
  EXPECT_TRUE(says(polar([](double phi) { return 0.5 + std::cos(phi); }), "positive"));
  EXPECT_TRUE(says(polar([](double) { return std::nan(""); }), "is nan"));
  EXPECT_TRUE(says(polar([](double phi) { return 4 + phi; }), "does not close"));
  EXPECT_TRUE(says(polar([](double phi) { return phi > 1 && phi < 2 ? 1. : 1.5; }),
                   "jumps at phi = 1"));
}

TEST(Outline, BoundsSeeTheWallAndWhatLiesWithinOnly)
{
  Scene scene;
  scene.domain.shape = DomainShape::outline;
  scene.domain.dimension = 2;
  scene.domain.outline = std::make_shared<const Outline>(angle_iron);
  scene.domain.upper = {1, 1, 0};
  scene.domain.reference_length = 2;
  EXPECT_EQ(scene.domain.side(), 2);
  EXPECT_FALSE(scene.domain.round());
  scene.initial.temperature = {"inside cold, outside hot", [](const Position &p, double)
                               { return p[0] > 0.5 && p[1] > 0.5 ? 100. : 3.; }};
  scene.boundaries[static_cast<std::size_t>(Side::outer)]
      = Boundary{BoundaryKind::fixed_temperature,
                 {"x", [](const Position &p, double) { return 4 + p[0]; }}};
  const TemperatureBounds bounds = temperature_bounds(scene);
  EXPECT_NEAR(bounds.lower, 3, 3e-3);
  EXPECT_NEAR(bounds.upper, 5, 3e-3);
}
