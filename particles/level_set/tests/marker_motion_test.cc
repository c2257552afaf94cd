#include "marker_samples.h"

#include <cases/error.h>
#include <particles/level_set/markers/marker_node_velocity.h>

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    void move(Markers &markers, const cases::VelocityField &velocity, double end,
              long steps, Carried carried, int threads = 1)
    {
      MarkerMotion motion("test", threads);
      for(long n = 0; n < steps; ++n)
        motion.step(markers, velocity, end * double(n) / double(steps),
                    end / double(steps), carried, n + 1);
    }

    /** From the polygon through points of a closed curve. */
    double distance_from_curve(const std::vector<Position> &points, const Position &at)
    {
      double nearest = std::numeric_limits<double>::infinity();
      for(std::size_t n = 0; n < points.size(); ++n)
      {
        const Position &a = points[n], &b = points[(n + 1) % points.size()];
        const double x = b[0] - a[0], y = b[1] - a[1];
        const double along = std::clamp(
            ((at[0] - a[0]) * x + (at[1] - a[1]) * y) / (x * x + y * y), 0., 1.);
        nearest = std::min(
            nearest, std::hypot(at[0] - a[0] - along * x, at[1] - a[1] - along * y));
      }
      return nearest;
    }

    TEST(MarkerMotion, PlacesConvergeWithThirdOrder)
    {
      const cases::SingleVortex vortex(4);
      const std::vector<GivenMarker> start{{{0.5, 0.7, 0}, 0, {0, 1, 0}},
                                           {{0.31, 0.42, 0}, 0, {1, 0, 0}}};
      double before = 0;
      for(const long steps : {40, 80, 160, 320})
      {
        Markers markers = given_markers(start);
        move(markers, vortex, 1.5, steps, Carried::position);
        double error = 0;
        for(std::size_t p = 0; p < start.size(); ++p)
        {
          const Position exact = vortex.carried(start[p].place, 0, 1.5, 2),
                         found = markers.point(p);
          error = std::max(error, std::hypot(found[0] - exact[0], found[1] - exact[1]));
        }
        if(before > 0)
        {
          EXPECT_GT(std::log2(before / error), 2.8) << steps;
        }
        before = error;
      }
      EXPECT_LT(before, 2e-6);
    }

    TEST(MarkerMotion, RigidMotionKeepsDistancesToTheLastBitAndTurnsNormals)
    {
      const cases::RigidMotion rotation({0.3, 0, 0}, 2, {0.5, 0.5, 0});
      const Grid grid = unit_grid(20);
      Markers markers = seed_markers(grid, circle, SeedingParameters{});
      const Markers start = markers;
      move(markers, rotation, 1, 200, Carried::distance_normal);
      EXPECT_EQ(markers.distance, start.distance);
      for(std::size_t p = 0; p < markers.size(); ++p)
      {
        const double nx = start.normal[0][p], ny = start.normal[1][p];
        EXPECT_NEAR(markers.normal[0][p], nx * std::cos(2) - ny * std::sin(2), 2e-5);
        EXPECT_NEAR(markers.normal[1][p], nx * std::sin(2) + ny * std::cos(2), 2e-5);
      }
    }

    /**
     * A linear flow u = G x carries the plane d = n . x to d / |F^-T n|, normal along
     * F^-T n, F = exp(G t): for shear u = a y exactly, F^-T n = (n_x, n_y - a t n_x).
     */
    TEST(MarkerMotion, StrainOfAShearedPlaneConvergesWithSecondOrder)
    {
      const double rate = 1.3, end = 1;
      const cases::FormulaVelocity shear("1.3 y, 0",
                                         {[=](const Position &p, double)
                                          { return rate * p[1]; },
                                          [](const Position &, double) { return 0.; },
                                          {}},
                                         1);
      const Position n{std::cos(0.4), std::sin(0.4), 0};
      const Position turned{n[0], n[1] - rate * end * n[0], 0};
      const double length = std::hypot(turned[0], turned[1]);
      double before = 0;
      for(const long steps : {20, 40, 80, 160})
      {
        Markers markers = given_markers({{{0.1 * n[0], 0.1 * n[1], 0}, 0.1, n}});
        move(markers, shear, end, steps, Carried::distance_normal);
        const double error = std::abs(markers.distance[0] / (0.1 / length) - 1)
                             + std::hypot(markers.normal[0][0] - turned[0] / length,
                                          markers.normal[1][0] - turned[1] / length);
        if(before > 0)
        {
          EXPECT_GT(std::log2(before / error), 1.9) << steps;
        }
        before = error;
      }
      EXPECT_LT(before, 2e-4);
    }

    TEST(MarkerMotion, InSpaceStrainIsOfSecondOrderToo)
    {
      // u = (0, a x + b z, 0): F = 1 + t (...), F^-T n = n - n_y t (a, 0, b)
      const double a = 0.8, b = -1.1;
      const auto none = [](const Position &, double) { return 0.; };
      const cases::FormulaVelocity shear(
          "shear",
          {none, [=](const Position &p, double) { return a * p[0] + b * p[2]; }, none},
          1);
      const Position n{0.36, 0.8, 0.48}, turned{n[0] - a * n[1], n[1], n[2] - b * n[1]};
      const double length = std::hypot(turned[0], turned[1], turned[2]);
      double before = 0;
      for(const long steps : {20, 40, 80, 160})
      {
        Markers markers = given_markers({{{0.02, 0.1, 0.3}, -0.2, n}}, 3);
        move(markers, shear, 1, steps, Carried::distance_normal);
        const double error = std::abs(markers.distance[0] / (-0.2 / length) - 1)
                             + std::abs(markers.normal[2][0] - turned[2] / length);
        if(before > 0)
        {
          EXPECT_GT(std::log2(before / error), 1.9) << steps;
        }
        before = error;
      }
      EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-14);
    }

    /** In the vortex: what a marker believes against the true distance from the moved
     * circle, found among many of its points; of second order in the distance. */
    TEST(MarkerMotion, CarriedDistancesAreThoseOfTheMovedFront)
    {
      const cases::SingleVortex vortex(8);
      constexpr double end = 0.8;
      std::vector<Position> front;
      for(int n = 0; n < 4000; ++n)
      {
        const double a = 2 * pi * n / 4000;
        front.push_back(vortex.carried(
            {0.5 + 0.15 * std::cos(a), 0.75 + 0.15 * std::sin(a), 0}, 0, end, 2));
      }
      const auto worst_error = [&](double away)
      {
        std::vector<GivenMarker> list;
        for(double a = 0.1; a < 6; a += 0.6)
          list.push_back(
              {{0.5 + (0.15 - away) * std::cos(a), 0.75 + (0.15 - away) * std::sin(a), 0},
               away,
               {-std::cos(a), -std::sin(a), 0}});
        Markers markers = given_markers(list);
        move(markers, vortex, end, 400, Carried::distance_normal);
        double worst = 0;
        for(std::size_t p = 0; p < markers.size(); ++p)
        {
          const double nearest = distance_from_curve(front, markers.point(p));
          worst = std::max(worst, std::abs(nearest - markers.distance[p]));
        }
        return worst;
      };
      const double coarse = worst_error(0.002), fine = worst_error(0.001);
      EXPECT_LT(coarse, 0.0008);
      EXPECT_GT(coarse / fine, 3.3);
    }

    TEST(MarkerMotion, ThreadsDoNotChangeABit)
    {
      const cases::SingleVortex vortex(8);
      const Grid grid = unit_grid(80);
      Markers one = seed_markers(grid, circle, SeedingParameters{}), two = one;
      ASSERT_GT(one.size(), 1000u);
      move(one, vortex, 0.5, 40, Carried::distance_normal, 1);
      move(two, vortex, 0.5, 40, Carried::distance_normal, 2);
      EXPECT_EQ(one.position, two.position);
      EXPECT_EQ(one.distance, two.distance);
      EXPECT_EQ(one.normal, two.normal);
    }

    TEST(MarkerMotion, AVelocityThatIsNoNumberStopsTheStep)
    {
      const cases::FormulaVelocity broken(
          "broken",
          {[](const Position &, double time)
           { return time > 0.45 ? std::numeric_limits<double>::quiet_NaN() : 1; },
           [](const Position &, double) { return 0.; },
           {}},
          1);
      Markers markers = given_markers({{{0.5, 0.5, 0}, 0, {1, 0, 0}}});
      try
      {
        move(markers, broken, 1, 10, Carried::position);
        FAIL();
      }
      catch(const cases::NumericalError &error)
      {
        EXPECT_EQ(error.step, 5);
      }
    }

    TEST(MarkerMotion, CarryingNeedsNormals)
    {
      SeedingParameters parameters;
      parameters.normals = false;
      Markers markers = seed_markers(unit_grid(20), circle, parameters);
      EXPECT_THROW(move(markers, cases::SingleVortex(8), 1, 10, Carried::distance_normal),
                   cases::InputError);
    }

    TEST(NodeVelocity, IsExactForALinearVelocityAndItsGradient)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid = unit_grid(6, dimension);
        NodeVelocity velocity(grid);
        for(int d = 0; d < dimension; ++d)
          for(std::size_t node = 0; node < grid.size(); ++node)
          {
            const Position at = grid.position(node);
            velocity.component(d)[node] = d + at[0] - 2 * d * at[1] + 3 * at[2];
          }
        const Position at{0.37, 0.91, dimension == 3 ? 0.02 : 0.};
        const Position found = velocity.velocity(at, 0, dimension);
        std::array<double, 9> entries{};
        cases::PointArrays points;
        std::array<std::span<double>, 9> gradient;
        for(int i = 0; i < dimension; ++i)
          points[i] = {&at[i], 1};
        for(int i = 0; i < 9; ++i)
          gradient[i] = {&entries[i], 1};
        velocity.gradients(points, 0, gradient);
        for(int d = 0; d < dimension; ++d)
        {
          EXPECT_NEAR(found[d], d + at[0] - 2 * d * at[1] + 3 * at[2], 1e-14);
          EXPECT_NEAR(entries[3 * d], 1, 1e-13);
          EXPECT_NEAR(entries[3 * d + 1], -2 * d, 1e-13);
          EXPECT_NEAR(entries[3 * d + 2], dimension == 3 ? 3 : 0, 1e-13);
        }
      }
    }
  } // namespace
} // namespace meltfront::particles::level_set
