#include <cases/error.h>
#include <particles/level_set/front_contour.h>
#include <particles/level_set/front_measures.h>
#include <particles/level_set/level_set_run.h>
#include <particles/level_set/reinitialisation.h>
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

    double area(const FrontLine &line)
    {
      double sum = 0;
      for(std::size_t n = 0; n < line.points.size(); ++n)
      {
        const Position &a = line.points[n],
                       &b = line.points[(n + 1) % line.points.size()];
        sum += a[0] * b[1] - a[1] * b[0];
      }
      return sum / 2;
    }

    TEST(SlottedDisk, DistanceIsThatOfTheNearestPointOfItsCurve)
    {
      const SlottedDisk slotted;
      const std::vector<Position> points = slotted.shape().front(1e-4);
      for(int j = 0; j <= 30; ++j)
        for(int i = 0; i <= 30; ++i)
        {
          const Position p{0.3 + 0.4 * i / 30. + 1e-5, 0.55 + 0.4 * j / 30., 0};
          double nearest = 1;
          for(const Position &point : points)
            nearest = std::min(nearest, apart(p, point));
          EXPECT_NEAR(std::abs(slotted.distance(p)), nearest, 6e-5)
              << p[0] << " " << p[1];
          EXPECT_EQ(slotted.distance(p) > 0, slotted.shape().inside(p));
        }
    }

    TEST(SlottedDisk, PerimeterAndAreaAreThoseOfItsCurve)
    {
      const ReferenceShape shape = SlottedDisk().shape();
      const std::vector<Position> points = shape.front(1e-4);
      double border = 0;
      for(std::size_t n = 0; n < points.size(); ++n)
        border += apart(points[n], points[(n + 1) % points.size()]);
      EXPECT_NEAR(border, shape.border, 1e-4);
      EXPECT_NEAR(area({points, true}), shape.content, 1e-5);
    }

    TEST(Carried, ADiskTurnedRoundIsADiskElsewhere)
    {
      const cases::RigidMotion motion({}, 2 * pi, {0.5, 0.5, 0});
      const ReferenceShape turned = carried(disk.shape(), motion, 0, 0.25);
      const Ball there{2, {0.25, 0.5, 0}, 0.15};
      for(int n = 0; n < 200; ++n)
      {
        const Position p{0.05 + 0.002 * n, 0.3 + 0.0019 * ((37 * n) % 200), 0};
        if(std::abs(there.distance(p)) > 1e-8)
        {
          EXPECT_EQ(turned.inside(p), there.distance(p) > 0);
        }
        EXPECT_NEAR(there.distance(turned.curve(n / 200.)), 0, 1e-9);
      }
      EXPECT_NEAR(turned.border, disk.shape().border, 1e-4);
      EXPECT_THROW(carried(ball.shape(), motion, 0, 1), cases::InputError);
    }

    TEST(Carried, TheVortexDrawsALineWhosePointsStayCloseEnough)
    {
      const cases::SingleVortex vortex(8);
      const ReferenceShape spiral = carried(disk.shape(), vortex, 0, 4);
      const std::vector<Position> points = spiral.front(0.01);
      for(std::size_t n = 0; n < points.size(); ++n)
        EXPECT_LE(apart(points[n], points[(n + 1) % points.size()]), 0.01);
      EXPECT_GT(spiral.border, 6 * disk.shape().border);
    }

    TEST(ShapeDifference, OfTheExactDiskIsTheFloorOfInterpolation)
    {
      for(const Ball &round : {disk, ball})
      {
        const Grid grid = unit_grid(round.dimension == 2 ? 80 : 40, round.dimension);
        const LevelSet front(grid, distance_from(round));
        const ReferenceShape shape = round.shape();
        const int samples = round.dimension == 2 ? 10 : 4;
        const ShapeDifference difference = shape_difference(front, shape, samples);
        EXPECT_LT(front_error(difference, shape, grid),
                  round.dimension == 2 ? 0.005 : 0.05);
        EXPECT_NEAR(content_error(difference, shape), 0,
                    round.dimension == 2 ? 0.001 : 0.02);
        EXPECT_DOUBLE_EQ(difference.content, content(front, samples));
        EXPECT_DOUBLE_EQ(difference.content - difference.extra,
                         difference.reference - difference.missing);
      }
    }

    TEST(ShapeDifference, OfADiskMovedBySpacingsIsWhatGeometryGives)
    {
      const Grid grid = unit_grid(80);
      const double shift = grid.spacing() * std::sqrt(2.);
      const Ball there{2, {0.5 + grid.spacing(), 0.75 + grid.spacing(), 0}, 0.15};
      const LevelSet front(grid, distance_from(there));
      const ReferenceShape shape = disk.shape();
      const ShapeDifference difference = shape_difference(front, shape, 10);
      const double r = disk.radius;
      const double overlap = 2 * r * r * std::acos(shift / (2 * r))
                             - shift / 2 * std::sqrt(4 * r * r - shift * shift);
      EXPECT_NEAR(difference.missing, shape.content - overlap, 4e-5);
      EXPECT_NEAR(difference.extra, shape.content - overlap, 4e-5);
      EXPECT_NEAR(front_error(difference, shape, grid), 0.899, 0.003);
      EXPECT_NEAR(difference.mismatch(), 2 * (1 - overlap / shape.content), 1e-3);
    }

    TEST(ShapeDifference, CountsWholeCellsFarFromEitherFront)
    {
      const Grid grid = unit_grid(20);
      const ReferenceShape shape = disk.shape();
      const LevelSet none(grid, [](const Position &) { return -1.; });
      const ShapeDifference nothing = shape_difference(none, shape, 10);
      EXPECT_EQ(nothing.content, 0);
      EXPECT_NEAR(nothing.missing, shape.content, 2e-4);
      const LevelSet all(grid, [](const Position &) { return 1.; });
      const ShapeDifference everything = shape_difference(all, shape, 10);
      EXPECT_NEAR(everything.content, 1, 1e-12);
      EXPECT_NEAR(everything.extra, 1 - shape.content, 2e-4);
    }

    TEST(ShapeDifference, ThreadsDoNotChangeABit)
    {
      const LevelSet one(unit_grid(40), distance_from(SlottedDisk()), {6, 1});
      const LevelSet two(unit_grid(40), distance_from(SlottedDisk()), {6, 2});
      const ReferenceShape shape = disk.shape();
      EXPECT_EQ(shape_difference(one, shape, 5).missing,
                shape_difference(two, shape, 5).missing);
      EXPECT_EQ(content(one, 10), content(two, 10));
    }

    TEST(ShapeDifference, HandsOnWhatAShapeThrows)
    {
      ReferenceShape shape = disk.shape();
      shape.inside
          = [](const Position &) -> bool { throw cases::InputError("no such shape"); };
      EXPECT_THROW(
          shape_difference(LevelSet(unit_grid(20), distance_from(disk)), shape, 2),
          cases::InputError);
    }

    TEST(FrontNoise, OfTheExactFrontsIsSmallAndOfNoneIsNothing)
    {
      const LevelSet front(unit_grid(80), distance_from(disk));
      const FrontNoise noise = front_noise(front, disk.front());
      EXPECT_LT(noise.normal, 0.05);
      EXPECT_LT(noise.curvature, 0.002);
      EXPECT_GT(noise.points, 90u);
      const LevelSet slotted(unit_grid(80), distance_from(SlottedDisk()));
      EXPECT_LT(front_noise(slotted, SlottedDisk().arc(0.04)).curvature, 0.002);
      const LevelSet none(unit_grid(20), [](const Position &) { return -1.; });
      EXPECT_EQ(front_noise(none, disk.front()).points, 0u);
    }

    TEST(Reinitialisation, AHundredIterationsLeaveADiskWhereItIs)
    {
      LevelSet front(unit_grid(80), distance_from(disk));
      const double before = area(front_lines(front).at(0));
      Reinitialisation()(front, 100);
      EXPECT_NEAR(area(front_lines(front).at(0)) / before, 1, 1e-5);
      EXPECT_LT(front_noise(front, disk.front()).curvature, 0.0015);
    }

    TEST(LevelSetRun, ZalesaksDiskLosesItsCorners)
    {
      const SlottedDisk slotted;
      const cases::RigidMotion motion({}, 2 * pi, {0.5, 0.5, 0});
      const Grid grid = unit_grid(80);
      const TransportResult result
          = run_level_set(grid, distance_from(slotted), motion, {});
      EXPECT_EQ(result.steps.steps, 503);
      const ReferenceShape shape = slotted.shape();
      const ShapeDifference difference = shape_difference(result.front, shape, 10);
      // a trial code of its own gave 4.50 % and 0.374
      EXPECT_NEAR(content_error(difference, shape), 0.045, 0.002);
      EXPECT_GT(front_error(difference, shape, grid), 0.3);
      EXPECT_LT(front_error(difference, shape, grid), 0.45);
    }

    TEST(LevelSetRun, TheVortexTakesTheFilamentAway)
    {
      const cases::SingleVortex vortex(8);
      TransportParameters parameters;
      parameters.end_time = 4;
      const TransportResult result
          = run_level_set(unit_grid(80), distance_from(disk), vortex, parameters);
      EXPECT_EQ(result.steps.steps, 640);
      const ReferenceShape spiral = carried(disk.shape(), vortex, 0, 4);
      const ShapeDifference difference = shape_difference(result.front, spiral, 5);
      // a trial code of its own gave -64.5 % and 65.1 %
      EXPECT_NEAR(content_error(difference, spiral), -0.645, 0.01);
      EXPECT_NEAR(difference.mismatch(), 0.651, 0.01);
    }

    TEST(LevelSetRun, TheBallInTheDeformedCubeKeepsItsVolumeAtFirst)
    {
      const cases::CubeDeformation deformation(3);
      TransportParameters parameters;
      parameters.end_time = 0.3;
      const TransportResult result
          = run_level_set(unit_grid(32, 3), distance_from(ball), deformation, parameters);
      const double before = content(LevelSet(unit_grid(32, 3), distance_from(ball)), 4);
      EXPECT_NEAR(content(result.front, 4) / before, 1, 0.05);
    }

    /** Nodes of the band in an average step of a disk or ball that turns. */
    double work_per_step(int cells, int dimension)
    {
      const Ball round{dimension, {0.5, 0.5, 0.5}, 0.3};
      const cases::RigidMotion turning({}, 1, {0.5, 0.5, 0});
      TransportParameters parameters;
      parameters.end_time = 2. / cells;
      const TransportResult result = run_level_set(
          unit_grid(cells, dimension), distance_from(round), turning, parameters);
      return result.node_steps / double(result.steps.steps);
    }

    TEST(LevelSetRun, WorkPerStepGrowsWithTheFrontAndNotWithTheGrid)
    {
      for(const int dimension : {2, 3})
      {
        const int coarse = dimension == 2 ? 80 : 50;
        const double exponent = std::log2(work_per_step(2 * coarse, dimension)
                                          / work_per_step(coarse, dimension));
        EXPECT_NEAR(exponent, dimension - 1, 0.15);
      }
    }

    TEST(LevelSetRun, CallsBackAtTheStartAndAfterEachStep)
    {
      const cases::RigidMotion motion({1, 0, 0}, 0, {});
      TransportParameters parameters;
      parameters.end_time = 0.1;
      parameters.equal_parts = 4;
      std::vector<double> times;
      const TransportResult result
          = run_level_set(unit_grid(40), distance_from(disk), motion, parameters,
                          [&](const TransportStep &at)
                          {
                            EXPECT_EQ(at.step, long(times.size()));
                            times.push_back(at.time);
                          });
      EXPECT_EQ(result.steps.steps, 8);
      EXPECT_EQ(times.size(), 9u);
      EXPECT_EQ(times.back(), 0.1);
      EXPECT_DOUBLE_EQ(times[4], 0.05);
    }

    TEST(LevelSetRun, GoesOnWithoutAFrontAndAtRest)
    {
      const cases::RigidMotion motion({1, 0, 0}, 0, {}), rest({}, 0, {});
      const TransportResult none = run_level_set(
          unit_grid(20), [](const Position &) { return -1.; }, motion, {});
      EXPECT_EQ(none.node_steps, 0);
      EXPECT_EQ(content(none.front, 4), 0);
      EXPECT_EQ(run_level_set(unit_grid(20), distance_from(disk), rest, {}).steps.steps,
                1);
    }

    TEST(LevelSetRun, RefusesWhatItCannotRun)
    {
      const cases::RigidMotion motion({1, 0, 0}, 0, {}), broken({NAN, 0, 0}, 0, {}),
          fast({1e12, 0, 0}, 0, {});
      const Grid grid = unit_grid(20);
      const auto run = [&](const cases::VelocityField &field, auto change)
      {
        TransportParameters parameters;
        change(parameters);
        run_level_set(grid, distance_from(disk), field, parameters);
      };
      const auto as_it_is = [](TransportParameters &) {};
      EXPECT_THROW(run(motion, [](auto &p) { p.end_time = 0; }), cases::InputError);
      EXPECT_THROW(run(motion, [](auto &p) { p.end_time = NAN; }), cases::InputError);
      EXPECT_THROW(run(motion, [](auto &p) { p.courant_number = 1.1; }),
                   cases::InputError);
      EXPECT_THROW(run(motion, [](auto &p) { p.reinitialise_every = -1; }),
                   cases::InputError);
      EXPECT_THROW(run(motion, [](auto &p) { p.equal_parts = 0; }), cases::InputError);
      EXPECT_THROW(run(broken, as_it_is), cases::InputError);
      EXPECT_THROW(run(fast, as_it_is), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::level_set
