#include <cases/error.h>
#include <particles/level_set/advection.h>
#include <particles/level_set/extension.h>
#include <particles/level_set/front_contour.h>
#include <particles/level_set/front_geometry.h>
#include <particles/level_set/tests/shapes.h>

#include <gtest/gtest.h>

#include <numbers>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    double apart(const Position &a, const Position &b)
    {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }

    /** Twice the area of a polygon, positive counterclockwise. */
    double turned_area(const std::vector<Position> &points)
    {
      double sum = 0;
      for(std::size_t n = 0; n < points.size(); ++n)
      {
        const Position &a = points[n], &b = points[(n + 1) % points.size()];
        sum += a[0] * b[1] - a[1] * b[0];
      }
      return sum;
    }

    double length(const FrontLine &line)
    {
      double sum = line.closed ? apart(line.points.back(), line.points.front()) : 0;
      for(std::size_t n = 1; n < line.points.size(); ++n)
        sum += apart(line.points[n - 1], line.points[n]);
      return sum;
    }

    /** Largest errors of curvature, over 1/R, and of normals at the front. */
    std::array<double, 2> geometry_errors(const Ball &round, int cells)
    {
      const LevelSet front(unit_grid(cells, round.dimension), distance_from(round));
      const ExactFrontFunction exact = round.front();
      std::array<double, 2> errors{};
      for(const Position &point : front_points(front))
      {
        const ExactFront at = *exact(point);
        errors[0] = std::max(errors[0], std::abs(curvature(front, point) - at.curvature)
                                            * round.radius);
        errors[1] = std::max(errors[1], apart(outward_normal(front, point), at.normal));
      }
      return errors;
    }

    TEST(FrontGeometry, CurvatureAndNormalsOfRoundFrontsAreOfSecondOrder)
    {
      const std::vector<std::vector<int>> levels{{40, 80, 160, 320}, {40, 56, 80, 112}};
      for(const Ball &round : {disk, ball})
      {
        const std::vector<int> &cells = levels[round.dimension - 2];
        std::vector<std::array<double, 2>> errors;
        for(const int n : cells)
          errors.push_back(geometry_errors(round, n));
        for(const int what : {0, 1})
        {
          const double order = std::log(errors.front()[what] / errors.back()[what])
                               / std::log(double(cells.back()) / cells.front());
          EXPECT_GT(order, 1.8) << round.dimension << "D, " << what;
          EXPECT_LT(errors.back()[what], 0.01);
        }
      }
    }

    TEST(FrontGeometry, CurvatureIsPositiveForARoundPhaseAndNegativeAroundAHole)
    {
      const LevelSet phase(unit_grid(80), distance_from(disk));
      const LevelSet hole(unit_grid(80),
                          [](const Position &p) { return -disk.distance(p); });
      const Position on_front{0.65, 0.75, 0};
      EXPECT_NEAR(curvature(phase, on_front), 1 / 0.15, 0.05);
      EXPECT_NEAR(curvature(hole, on_front), -1 / 0.15, 0.05);
      EXPECT_NEAR(outward_normal(phase, on_front)[0], 1, 1e-3);
      EXPECT_NEAR(outward_normal(hole, on_front)[0], -1, 1e-3);
    }

    TEST(FrontGeometry, WhatHasNoSlopeHasNoNormalAndNoCurvature)
    {
      const LevelSet flat(unit_grid(10), [](const Position &) { return 1.; }, {0, 1});
      EXPECT_EQ(outward_normal(flat, {0.52, 0.5, 0}), (Position{}));
      EXPECT_EQ(curvature(flat, {0.52, 0.5, 0}), 0);
      EXPECT_EQ(closest_on_front(flat, {0.52, 0.5, 0}), (Position{0.52, 0.5, 0}));
    }

    TEST(FrontGeometry, ClosestPointsLieOnTheFront)
    {
      const LevelSet front(unit_grid(80), distance_from(disk));
      const double spacing = front.grid().spacing();
      for(int n = 0; n < 40; ++n)
      {
        const double angle = 0.16 * n, radius = 0.15 + spacing * (0.05 * n - 1);
        const Position found = closest_on_front(
            front, {0.5 + radius * std::cos(angle), 0.75 + radius * std::sin(angle), 0});
        const Position right{0.5 + 0.15 * std::cos(angle), 0.75 + 0.15 * std::sin(angle),
                             0};
        EXPECT_LT(apart(found, right), 0.03 * spacing);
      }
    }

    TEST(FrontLines, OfADiskIsOneClosedLineCounterclockwise)
    {
      const LevelSet front(unit_grid(80), distance_from(disk));
      const std::vector<FrontLine> lines = front_lines(front);
      ASSERT_EQ(lines.size(), 1u);
      EXPECT_TRUE(lines[0].closed);
      EXPECT_EQ(lines[0].points.size(), front_points(front).size());
      EXPECT_NEAR(turned_area(lines[0].points) / 2, pi * 0.15 * 0.15, 2e-4);
      EXPECT_NEAR(length(lines[0]), 2 * pi * 0.15, 2e-3);
      for(const Position &point : lines[0].points)
        EXPECT_NEAR(disk.distance(point), 0, 2e-4);
    }

    TEST(FrontLines, HolesAreGoneRoundClockwise)
    {
      const LevelSet ring(unit_grid(80),
                          [](const Position &p)
                          {
                            const double r = std::hypot(p[0] - 0.5, p[1] - 0.5);
                            return std::min(0.35 - r, r - 0.2);
                          });
      const std::vector<FrontLine> lines = front_lines(ring);
      ASSERT_EQ(lines.size(), 2u);
      EXPECT_NEAR(turned_area(lines[0].points) / 2, pi * 0.35 * 0.35, 1e-3);
      EXPECT_NEAR(turned_area(lines[1].points) / 2, -pi * 0.2 * 0.2, 1e-3);
    }

    TEST(FrontLines, LeaveOutPointsThatAreTooClose)
    {
      const LevelSet front(unit_grid(80), distance_from(disk));
      const double spacing = front.grid().spacing();
      const std::vector<FrontLine> lines = front_lines(front, spacing);
      ASSERT_EQ(lines.size(), 1u);
      const std::vector<Position> &points = lines[0].points;
      for(std::size_t n = 0; n < points.size(); ++n)
      {
        const double gap = apart(points[n], points[(n + 1) % points.size()]);
        EXPECT_GE(gap, spacing);
        EXPECT_LT(gap, 3 * spacing);
      }
    }

    TEST(FrontLines, EndOnTheBorder)
    {
      const LevelSet half(unit_grid(40), distance_from(Ball{2, {0, 0.5, 0}, 0.2}));
      for(const double spacing : {0., 0.025})
      {
        const std::vector<FrontLine> lines = front_lines(half, spacing);
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_FALSE(lines[0].closed);
        EXPECT_NEAR(lines[0].points.front()[0], 0, 1e-14);
        EXPECT_NEAR(lines[0].points.back()[0], 0, 1e-14);
        // the phase on the left: from the lower end to the upper one
        EXPECT_LT(lines[0].points.front()[1], lines[0].points.back()[1]);
        EXPECT_NEAR(length(lines[0]), pi * 0.2, 0.005);
      }
    }

    TEST(FrontLines, TheMiddleDecidesCellsCutOnFourSides)
    {
      for(const double middle : {0.1, -0.1})
      {
        const LevelSet saddle(unit_grid(5),
                              [&](const Position &p)
                              { return (p[0] - 0.5) * (p[1] - 0.5) + 0.1 * middle; },
                              {0, 1});
        // the diagonal corners of the middle cell joined by the phase, or apart
        const std::vector<FrontLine> lines = front_lines(saddle);
        ASSERT_EQ(lines.size(), 2u);
        for(const FrontLine &line : lines)
        {
          double least = 1, most = -1;
          for(const Position &p : line.points)
          {
            least = std::min(least, (p[0] - 0.5) - (p[1] - 0.5));
            most = std::max(most, (p[0] - 0.5) - (p[1] - 0.5));
          }
          EXPECT_EQ(least * most > 0, middle > 0);
        }
      }
    }

    TEST(FrontLines, NoneWithoutAFrontAndNoneInSpace)
    {
      const LevelSet none(unit_grid(10), [](const Position &) { return -1.; });
      EXPECT_TRUE(front_lines(none).empty());
      EXPECT_TRUE(front_points(none).empty());
      const LevelSet solid(unit_grid(30, 3), distance_from(ball));
      EXPECT_THROW(front_lines(solid), cases::InputError);
      const std::vector<Position> points = front_points(solid);
      EXPECT_GT(points.size(), 200u);
      for(const Position &point : points)
        EXPECT_NEAR(ball.distance(point), 0, 2e-3);
    }

    /** Mean error of cos(angle) carried from the front out to 0.08. */
    double extension_error(int cells)
    {
      const LevelSet front(unit_grid(cells), distance_from(disk), {cells / 10, 1});
      const ScalarFunction cosine = [](const Position &p)
      { return (p[0] - 0.5) / std::hypot(p[0] - 0.5, p[1] - 0.75); };
      std::vector<double> found(front.band().size());
      Extension extend;
      extend(front, cosine, found);
      double error = 0, count = 0;
      std::size_t number = 0;
      for_each_node(front.grid(), front.band(),
                    [&](std::size_t node, const Position &p)
                    {
                      if(std::abs(front.values()[node]) < 0.08)
                      {
                        error += std::abs(found[number] - cosine(p));
                        ++count;
                      }
                      ++number;
                    });
      return error / count;
    }

    TEST(Extension, IsConstantAlongNormalsToFirstOrder)
    {
      std::vector<double> errors;
      for(const int cells : {80, 160, 320, 640})
        errors.push_back(extension_error(cells));
      EXPECT_GT(std::log2(errors[0] / errors[3]) / 3, 0.9)
          << errors[0] << " " << errors[3];
      EXPECT_GT(std::log2(errors[2] / errors[3]), 0.94);
    }

    TEST(Extension, KeepsConstantsExactly)
    {
      for(const Ball &round : {disk, ball})
      {
        const LevelSet front(unit_grid(40, round.dimension), distance_from(round));
        std::vector<double> found(front.band().size());
        Extension extend;
        extend(
            front, [](const Position &) { return 2.5; }, found);
        for(const double value : found)
          EXPECT_NEAR(value, 2.5, 1e-15 * 8);
      }
    }

    TEST(Extension, ADiskThatGrowsAlongItsNormalsStaysADisk)
    {
      LevelSet front(unit_grid(80), distance_from(disk));
      Extension extend;
      Advection advection;
      std::vector<double> speed;
      const VelocityFunction velocity
          = [&](const cases::PointArrays &, double,
                const std::array<std::span<double>, 3> &result)
      {
        speed.resize(front.band().size());
        extend(
            front, [](const Position &) { return 0.5; }, speed);
        normal_velocities(front, speed, result);
      };
      for(long step = 0; step < 16; ++step)
        advection.step(front, velocity, {step, 0.01 * step, 0.01});
      for(int n = 0; n < 40; ++n)
        EXPECT_NEAR(front.value({0.5 + 0.23 * std::cos(0.16 * n),
                                 0.75 + 0.23 * std::sin(0.16 * n), 0}),
                    0, 0.02 * front.grid().spacing());
    }
  } // namespace
} // namespace meltfront::particles::level_set
