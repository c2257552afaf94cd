#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/point_sink.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double end = 475000;

    std::shared_ptr<const LineSink> line_sink()
    {
      return std::make_shared<LineSink>(water(), 0.15, 10);
    }

    PointSource source_of(const std::shared_ptr<const LineSink> &exact)
    {
      const double strength = exact->strength();
      return {{},
              "constant",
              [strength](double) { return -strength; },
              [strength](double time) { return -strength * time; }};
    }

    Scene line_sink_disk()
    {
      const auto exact = line_sink();
      Scene scene = ball(water(), 2, 0.5, 10, end);
      set_boundary(scene, Side::outer, exact_wall(exact));
      scene.sources.push_back(source_of(exact));
      return scene;
    }

    Scene line_sink_square(const Position &position = {})
    {
      const auto exact = line_sink();
      Scene scene = box(water(), 2, {-0.5, -0.5, 0}, {0.5, 0.5, 0}, 10, end);
      scene.symmetry = Symmetry::cylindrical;
      scene.sources.push_back(source_of(exact));
      scene.sources.back().position = position;
      return scene;
    }

    Scene point_sink_ball()
    {
      const auto exact = std::make_shared<PointSink>(water(), 0.15, 10);
      Scene scene = ball(water(), 3, 0.5, 10, end);
      set_boundary(scene, Side::outer, exact_wall(exact));
      scene.sources.push_back({{},
                               "square root",
                               [exact](double time) { return -exact->strength(time); },
                               [exact](double time) { return -exact->energy(time); }});
      return scene;
    }

    void expect_sound(const RunRecord &record)
    {
      EXPECT_LE(record.worst_budget_defect(), 1e-13);
      EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
      EXPECT_EQ(record.cost.capped_steps, 0);
    }

    TEST(LineSink, DiskInOneDimension)
    {
      const auto exact = line_sink();
      const std::vector<int> n{64, 128, 256, 512, 1024};
      std::vector<double> errors;
      for(const int cells : n)
      {
        const RunRecord record = run(line_sink_disk(), cells, {}, exact.get());
        expect_sound(record);
        EXPECT_EQ(record.description.dimension, 1);
        EXPECT_NEAR(record.heat.sources, -exact->strength() * end,
                    1e-13 * exact->strength() * end);
        errors.push_back(record.worst_front_error(end / 2));
      }
      EXPECT_LE(errors.back(), 1e-4);
      EXPECT_GE(fitted_order(n, errors), 1.3);
    }

    TEST(PointSink, BallInOneDimension)
    {
      const PointSink exact(water(), 0.15, 10);
      const std::vector<int> n{64, 128, 256, 512, 1024};
      std::vector<double> errors;
      for(const int cells : n)
      {
        const RunRecord record = run(point_sink_ball(), cells, {}, &exact);
        expect_sound(record);
        EXPECT_NEAR(record.heat.sources, -exact.energy(end), 1e-13 * exact.energy(end));
        errors.push_back(record.worst_front_error(end / 2));
      }
      EXPECT_LE(errors.back(), 1.5e-4);
      EXPECT_GE(fitted_order(n, errors), 1.3);
    }

    TEST(LineSink, SquareInTwoDimensions)
    {
      const auto exact = line_sink();
      Scene scene = line_sink_square();
      for(const Side side : scene.sides())
        set_boundary(scene, side, exact_wall(exact));
      const std::vector<int> n{16, 32, 64, 128};
      std::vector<double> errors;
      for(const int cells : n)
      {
        const RunRecord record = run(scene, cells, {}, exact.get());
        expect_sound(record);
        errors.push_back(record.worst_front_error(end / 2));
      }
      EXPECT_LE(errors.back(), 2.5e-3);
      EXPECT_GE(fitted_order(n, errors), 1.0);
    }

    TEST(LineSink, InsulatedSquareLosesNoHeatWhereverTheSinkLies)
    {
      for(const Position position : {Position{}, {0.123, -0.217, 0}, {0.5, 0.5, 0}})
      {
        const RunRecord record = run(line_sink_square(position), 24);
        expect_sound(record);
        EXPECT_EQ(record.heat.boundary, 0);
        EXPECT_NEAR(record.heat.stored + record.heat.latent - record.heat.initial,
                    record.heat.sources, 1e-12 * record.heat.initial);
      }
    }

    TEST(LineSink, DiskInTwoDimensions)
    {
      const auto exact = line_sink();
      std::vector<double> errors;
      for(const int cells : {16, 32, 64})
      {
        const RunRecord record
            = run(line_sink_disk(), cells, {{"dimension", "2"}}, exact.get());
        expect_sound(record);
        EXPECT_EQ(record.description.dimension, 2);
        errors.push_back(record.worst_front_error(end / 2));
      }
      EXPECT_LT(errors[1], errors[0]);
      EXPECT_LT(errors[2], errors[1]);
      EXPECT_LE(errors[2], 8e-3);
    }

    TEST(PointSink, BallInThreeDimensions)
    {
      const PointSink exact(water(), 0.15, 10);
      const RunRecord record
          = run(point_sink_ball(), 16, {{"dimension", "3"}, {"steps", "30"}}, &exact);
      expect_sound(record);
      EXPECT_LE(record.worst_front_error(end / 2), 6e-2);
    }

    TEST(Sources, AwayFromTheCentreNeedTheFullDimension)
    {
      Scene scene = line_sink_disk();
      scene.sources[0].position = {0.1, 0, 0};
      EXPECT_THROW(run(scene, 16), Refusal);
      scene = line_sink_square({0.6, 0, 0});
      EXPECT_THROW(run(scene, 16), InputError);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
