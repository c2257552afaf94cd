#include <cases/expression_words.h>
#include <cases/mean_with_jumps.h>
#include <cases/means_of_jumps.h>
#include <cases/outline.h>
#include <cases/tests/support/scenes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

using namespace meltfront::cases;
using namespace meltfront::test_support;

namespace
{
  Boundary flux_of(const std::string &expression,
                   std::function<double(const Position &)> value)
  {
    return {BoundaryKind::flux,
            {expression,
             [value = std::move(value)](const Position &p, double) { return value(p); }}};
  }

  double seen(const Scene &scene, double width, Side side, const Position &place)
  {
    return with_means_of_jumps(scene, [width](Side) { return width; })
        .boundary(side)
        .value(place, 0);
  }

  Scene unit_box(int dimension)
  {
    return box(unit_material(), dimension, {0, 0, 0}, {1, 1, 1}, 0, 1);
  }

  TEST(MeanWithJumps, IsExactForALineAndForAStep)
  {
    const auto line = [](double x) { return 3 * x - 1; };
    EXPECT_NEAR(mean_with_jumps(line, 0.2, 0.9, 4, 12), 3 * 0.55 - 1, 1e-14);
    for(const double at : {0.2, 0.2001, 0.31, 0.5, 0.777, 0.8999})
    {
      const auto step = [at](double x) { return x < at ? -7. : 2.; };
      EXPECT_NEAR(mean_with_jumps(step, 0.2, 0.9, 4, 12),
                  (-7 * (at - 0.2) + 2 * (0.9 - at)) / 0.7, 9. / (4 << 12));
    }
    EXPECT_EQ(mean_with_jumps([](double) { return 0.1; }, 0, 1, 3, 5), 0.1);
  }

  TEST(MeanWithJumps, OfADiskOverASquareIsItsArea)
  {
    const auto disk
        = [](const Position &p) { return p[0] * p[0] + p[1] * p[1] < 1 ? 1. : 0.; };
    EXPECT_NEAR(mean_over_box(disk, {}, {0, 0, 0}, {1, 1, 0}, 2, 32, 8),
                std::numbers::pi / 4, 2e-4);
  }

  TEST(JumpBetween, IsTheHeightOfAStepAndNextToNothingOfARamp)
  {
    const auto value = [](double of_ramp)
    {
      return [of_ramp](const Position &p)
      { return (p[0] + 0.4 * p[1] < 0.617 ? -0.9 : 0.6) + of_ramp * p[0]; };
    };
    const Jump jump = jump_between(value(0.3), {0.4, 0.1, 0}, {0.7, 0.3, 0});
    EXPECT_NEAR(jump.height, 1.5, 1e-9);
    EXPECT_NEAR(jump.place[0] + 0.4 * jump.place[1], 0.617, 1e-12);
    EXPECT_NEAR(jump_between(value(0.3), {0.1, 0.1, 0}, {0.4, 0.3, 0}).height, 0, 1e-9);
    const auto steep
        = [](const Position &p) { return std::clamp(1e3 * (p[0] - 0.5), 0., 1.); };
    EXPECT_NEAR(jump_between(steep, {0.4, 0, 0}, {0.7, 0, 0}).height, 0, 1e-3);
  }

  // A jump of half a kelvin is one, whatever the zero of the scale is.
  TEST(MeanWithJumps, KnowNoScale)
  {
    for(const double zero : {0., 660.3, -1e4})
      EXPECT_NEAR(mean_with_jumps([zero](double x)
                                  { return x < 0.3001 ? zero : zero + 0.5; },
                                  0, 1, 4, 12),
                  zero + 0.5 * 0.6999, 1e-4);
  }

  TEST(MeansOfJumps, AreTakenWhereAnExpressionComparesPlacesAlone)
  {
    for(const char *jumps :
        {"if(x < 0.5, 1, 2)", "3*sign(y - 1)", "floor (4*z)", "x < 1 ? 2 : 3",
         "if(t < 1, 0, if(x + t > 2, 1, 0))", "2*(y > 0.1)", "if(ceil(x) == 1, 1, 0)"})
      EXPECT_TRUE(may_jump_with(jumps, "xyz")) << jumps;
    for(const char *smooth :
        {"sin(x)", "if(t < 0.5, x, 2*x)", "x*sign(sin(t))", "max(x, 0)", "0: 1, 2: 3",
         "if((t < 1) && (t > 0.5), y, 0)", "if(t < 1, 2, 3)", "7"})
      EXPECT_FALSE(may_jump_with(smooth, "xyz")) << smooth;
  }

  TEST(MeansOfJumps, SumUpToTheIntegralAlongASide)
  {
    constexpr int n = 16;
    for(const double at : {0.03, 0.25, 0.4999, 0.5, 0.537, 0.99})
    {
      Scene scene = unit_box(2);
      set_boundary(scene, Side::y_max,
                   flux_of("if(x < 0.5, -6, 2)",
                           [at](const Position &p) { return p[0] < at ? -6. : 2.; }));
      double nodes = 0, middles = 0;
      for(int i = 0; i <= n; ++i)
        nodes += (i % n == 0 ? 0.5 : 1)
                 * seen(scene, 1. / n, Side::y_max, {double(i) / n, 1, 0}) / n;
      for(int i = 0; i < n; ++i)
        middles += seen(scene, 1. / n, Side::y_max, {(i + 0.5) / n, 1, 0}) / n;
      EXPECT_NEAR(nodes, 2 - 8 * at, 1e-4);
      EXPECT_NEAR(middles, 2 - 8 * at, 1e-4);
    }
  }

  TEST(MeansOfJumps, GoOnBeyondPeriodicEnds)
  {
    Scene scene = unit_box(2);
    for(const Side side : {Side::x_min, Side::x_max})
      set_boundary(scene, side, periodic_wall());
    set_boundary(scene, Side::y_min,
                 flux_of("if(x < 0.5, 1, 0)",
                         [](const Position &p) { return p[0] < 0.5 ? 1. : 0.; }));
    EXPECT_NEAR(seen(scene, 0.1, Side::y_min, {0, 0, 0}), 0.5, 1e-4);
    EXPECT_NEAR(seen(scene, 0.1, Side::y_min, {1, 0, 0}), 0.5, 1e-4);
  }

  TEST(MeansOfJumps, SumUpToTheIntegralOverASquare)
  {
    constexpr int n = 16;
    Scene scene = unit_box(3);
    set_boundary(scene, Side::z_min,
                 flux_of("if(x + 0.4*y < 0.7, 1, 0)", [](const Position &p)
                         { return p[0] + 0.4 * p[1] < 0.7 ? 1. : 0.; }));
    double sum = 0;
    for(int i = 0; i < n; ++i)
      for(int j = 0; j < n; ++j)
        sum += seen(scene, 1. / n, Side::z_min, {(i + 0.5) / n, (j + 0.5) / n, 0})
               / (n * n);
    EXPECT_NEAR(sum, 0.5, 1e-3);
  }

  TEST(MeansOfJumps, AreTakenAroundCirclesAndSpheres)
  {
    Scene disk = ball(unit_material(), 2, 0.5, 0, 1);
    set_boundary(disk, Side::outer,
                 flux_of("if(y > 0.2, 1, 0)",
                         [](const Position &p) { return p[1] > 0.2 ? 1. : 0.; }));
    constexpr int n = 48;
    double around = 0;
    for(int i = 0; i < n; ++i)
    {
      const double phi = 2 * std::numbers::pi * (i + 0.3) / n;
      around += seen(disk, std::numbers::pi / n, Side::outer,
                     {0.5 * std::cos(phi), 0.5 * std::sin(phi), 0})
                / n;
    }
    EXPECT_NEAR(around, std::acos(0.4) / std::numbers::pi, 1e-4);

    Scene sphere = ball(unit_material(), 3, 0.5, 0, 1);
    set_boundary(
        sphere, Side::outer,
        flux_of("if(z > 0, 1, 0)", [](const Position &p) { return p[2] > 0 ? 1. : 0.; }));
    const auto at = [&](double latitude)
    {
      return seen(sphere, 0.1, Side::outer,
                  {0.3 * std::cos(latitude), -0.4 * std::cos(latitude),
                   0.5 * std::sin(latitude)});
    };
    EXPECT_EQ(at(0.3), 1);
    EXPECT_EQ(at(-0.3), 0);
    EXPECT_GT(at(0.05), 0.5);
    EXPECT_LT(at(-0.05), 0.5);
  }

  TEST(MeansOfJumps, GoRoundTheCornersOfAnOutline)
  {
    Scene scene;
    scene.domain.shape = DomainShape::outline;
    scene.domain.dimension = 2;
    scene.domain.outline = std::make_shared<const Outline>(
        std::vector<Outline::Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    scene.domain.upper = {1, 1, 0};
    scene.domain.reference_length = 1;
    set_boundary(scene, Side::outer,
                 flux_of("if(y < 1e-9, 4, 1)",
                         [](const Position &p) { return p[1] < 1e-9 ? 4. : 1.; }));
    EXPECT_NEAR(seen(scene, 0.1, Side::outer, {1, 0, 0}), 2.5, 1e-3);
    EXPECT_NEAR(seen(scene, 0.1, Side::outer, {1, 0.025, 0}), 1.75, 1e-3);
    EXPECT_EQ(seen(scene, 0.1, Side::outer, {0.5, 0, 0}), 4);
    EXPECT_EQ(seen(scene, 0.1, Side::outer, {1, 0.5, 0}), 1);
  }

  TEST(MeansOfJumps, OfRadiationAreOfFourthPowers)
  {
    Scene scene = unit_box(2);
    Boundary wall = flux_of("if(x < 0.5, 300, 900)",
                            [](const Position &p) { return p[0] < 0.5 ? 300. : 900.; });
    wall.kind = BoundaryKind::radiation;
    wall.absolute_zero = -100;
    set_boundary(scene, Side::x_min, flux_wall(1));
    set_boundary(scene, Side::y_min, wall);
    EXPECT_NEAR(seen(scene, 0.1, Side::y_min, {0.5, 0, 0}),
                -100 + std::pow((std::pow(400, 4) + std::pow(1000, 4)) / 2, 0.25), 0.1);
    EXPECT_EQ(seen(scene, 0.1, Side::x_min, {0, 0.5, 0}), 1);
  }

  TEST(MeansOfJumps, OfWhatIsReleasedSumUpToTheIntegral)
  {
    constexpr int n = 20;
    Scene scene = unit_box(2);
    scene.volumetric_source = {"if(x^2 + y^2 < 0.3, 5, 0)", [](const Position &p, double)
                               { return p[0] * p[0] + p[1] * p[1] < 0.3 ? 5. : 0.; }};
    const Field release = mean_release(scene, 1. / n);
    double sum = 0;
    for(int i = 0; i < n; ++i)
      for(int j = 0; j < n; ++j)
        sum += release({(i + 0.5) / n, (j + 0.5) / n, 0}, 0) / (n * n);
    EXPECT_NEAR(sum, 5 * std::numbers::pi * 0.3 / 4, 1e-3);
    // By places alone it is off by more.
    double places = 0;
    for(int i = 0; i < n; ++i)
      for(int j = 0; j < n; ++j)
        places
            += (*scene.volumetric_source)({(i + 0.5) / n, (j + 0.5) / n, 0}, 0) / (n * n);
    EXPECT_GT(std::abs(places - 5 * std::numbers::pi * 0.3 / 4), 3e-3);
  }
} // namespace
