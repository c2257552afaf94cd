#include <particles/level_set/front_contour.h>
#include <particles/level_set/front_geometry.h>
#include <particles/level_set/tests/shapes.h>

#include <gtest/gtest.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    double apart(const Position &a, const Position &b)
    {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }

    /** Largest errors of curvature, over 1/R, and of normals at the front. */
    std::array<double, 2> geometry_errors(int dimension, int cells)
    {
      const cases::Ball &round = round_shape(dimension);
      const LevelSet front(unit_grid(cells, dimension), distance_from(round));
      std::array<double, 2> errors{};
      for(const Position &point : front_points(front))
      {
        errors[0] = std::max(
            errors[0], 0.15 * std::abs(curvature(front, point) - round.curvature(point)));
        errors[1] = std::max(
            errors[1], apart(outward_normal(front, point), outwards(point, dimension)));
      }
      return errors;
    }

    TEST(FrontGeometry, CurvatureAndNormalsOfRoundFrontsAreOfSecondOrder)
    {
      const std::vector<std::vector<int>> levels{{40, 80, 160, 320}, {40, 56, 80, 112}};
      for(const int dimension : {2, 3})
      {
        const std::vector<int> &cells = levels[dimension - 2];
        std::vector<std::array<double, 2>> errors;
        for(const int n : cells)
          errors.push_back(geometry_errors(dimension, n));
        for(const int what : {0, 1})
        {
          const double order = std::log(errors.front()[what] / errors.back()[what])
                               / std::log(double(cells.back()) / cells.front());
          EXPECT_GT(order, 1.8) << dimension << "D, " << what;
          EXPECT_LT(errors.back()[what], 0.01);
        }
      }
    }

    TEST(FrontGeometry, CurvatureIsPositiveForARoundPhaseAndNegativeAroundAHole)
    {
      const LevelSet phase(unit_grid(80), distance_from(disk));
      const LevelSet hole(unit_grid(80),
                          [](const Position &p) { return -disk.signed_distance(p); });
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
    }

    TEST(FrontPoints, LieOnTheFront)
    {
      const LevelSet none(unit_grid(10), [](const Position &) { return -1.; });
      EXPECT_TRUE(front_points(none).empty());
      for(const int dimension : {2, 3})
      {
        const LevelSet front(unit_grid(30, dimension),
                             distance_from(round_shape(dimension)));
        const std::vector<Position> points = front_points(front);
        EXPECT_GT(points.size(), dimension == 2 ? 30u : 200u);
        for(const Position &point : points)
          EXPECT_NEAR(round_shape(dimension).signed_distance(point), 0, 2e-3);
      }
    }
  } // namespace
} // namespace meltfront::particles::level_set
