#include <cases/dense_sampling.h>
#include <cases/error.h>
#include <cases/expression_words.h>
#include <cases/time_integral.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace meltfront::cases;

  /** 1e4 from 0.3171 to 0.3172 s, found by its breakpoints. */
  Field pulse()
  {
    return {"if(t >= 0.3171 && t < 0.3172, 1e4, 0)",
            [](const Position &, double t)
            { return t >= 0.3171 && t < 0.3172 ? 1e4 : 0.; },
            false,
            {0.3171, 0.3172}};
  }

  TEST(TimeMean, PulsesWithinAcrossAndBesideSteps)
  {
    const TimeMean mean(pulse());
    EXPECT_NEAR(mean({}, 0.317, 0.318), 1e3, 1e-8);
    EXPECT_NEAR(mean({}, 0.31, 0.31715), 0.5 / 0.00715, 1e-8);
    EXPECT_NEAR(mean({}, 0.31715, 0.33), 0.5 / 0.01285, 1e-8);
    EXPECT_EQ(mean({}, 0.3172, 1), 0);
    EXPECT_EQ(mean({}, 0, 0.3171), 0);
    EXPECT_EQ(mean({}, 0.31715, 0.31715), 1e4);
  }

  TEST(TimeMean, SmoothFunctionsToQuadratureAccuracy)
  {
    const TimeMean mean(
        {"sin(t)", [](const Position &, double t) { return std::sin(t); }});
    for(const double length : {1e-3, 0.1, 1., 30.})
      EXPECT_NEAR(mean({}, 2, 2 + length), (std::cos(2) - std::cos(2 + length)) / length,
                  1e-9)
          << length;
  }

  TEST(TimeMean, WhatMovesPastAPointNeedsNoBreakpoint)
  {
    const TimeMean mean({"if(x < t, 1, 0)",
                         [](const Position &p, double t) { return p[0] < t ? 1. : 0.; }});
    EXPECT_NEAR(mean({0.3337, 0, 0}, 0, 1), 0.6663, 1e-6);
  }

  TEST(TimeMean, WhatIsSteadyCostsOneCall)
  {
    int calls = 0;
    const auto counted = [&calls](const Position &p, double)
    {
      ++calls;
      return p[0];
    };
    EXPECT_EQ(TimeMean({"x", counted})({7, 0, 0}, 0, 1), 7);
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(TimeMean({"some words", counted})({7, 0, 0}, 0, 1), 7);
    EXPECT_EQ(calls, 4);
  }

  TEST(StepIntegrals, TheStepBeforeIsKept)
  {
    int calls = 0;
    StepIntegrals integrals({"t",
                             [&calls](const Position &, double t)
                             {
                               ++calls;
                               return t;
                             }},
                            {Position{}});
    EXPECT_NEAR(integrals.over(0, 1)[0], 0.5, 1e-15);
    EXPECT_NEAR(integrals.over(1, 2)[0], 1.5, 1e-15);
    const int before = calls;
    EXPECT_NEAR(integrals.over(0, 1)[0], 0.5, 1e-15);
    EXPECT_EQ(calls, before);
  }

  TEST(TimeMean, ValuesBesideAJump)
  {
    const Field field = pulse();
    EXPECT_EQ(value_at_end(field, {}, 0.3, 0.3171), 0);
    EXPECT_EQ(value_at_begin(field, {}, 0.3171, 0.3172), 1e4);
    EXPECT_EQ(value_at_end(field, {}, 0.3171, 0.3172), 1e4);
    EXPECT_EQ(value_at_begin(field, {}, 0.3172, 0.4), 0);
  }

  // 24/120 of 0.1 is 0.020000000000000004; 0.1 * 3 is not 0.3.
  TEST(Breakpoints, TimesThatRoundOffPartsAreOne)
  {
    const auto step = [](double at)
    {
      return Field{
          "", [at](const Position &, double t) { return t < at ? 0. : 1.; }, false, {at}};
    };
    Scene scene;
    scene.domain.shape = DomainShape::slab;
    scene.end_time = 1;
    scene.boundaries[0] = Boundary{BoundaryKind::fixed_temperature, step(0.3)};
    scene.boundaries[1] = Boundary{BoundaryKind::fixed_temperature, step(0.1 * 3)};
    ASSERT_NE(0.1 * 3, 0.3);
    const std::vector<double> breakpoints = breakpoints_of(scene);
    EXPECT_EQ(breakpoints, std::vector<double>{0.3});
    for(const Side side : {Side::x_min, Side::x_max})
    {
      const Field &value = scene.boundary(side).value;
      EXPECT_TRUE(breaks_at(value, 0.3));
      EXPECT_EQ(value_at_end(value, {}, 0.29, 0.3), 0);
      EXPECT_EQ(value_at_begin(value, {}, 0.3, 0.31), 1);
    }
    EXPECT_EQ(snap_to_breakpoint(breakpoints, 0.1 * 3), 0.3);
    EXPECT_EQ(snap_to_breakpoint(breakpoints, 0.3 - 1e-16), 0.3);
    EXPECT_EQ(snap_to_breakpoint(breakpoints, 0.3 + 1e-12), 0.3 + 1e-12);
    EXPECT_EQ(snap_to_breakpoint(breakpoints, 0.7), 0.7);
    EXPECT_EQ(snap_to_breakpoint({}, 0.7), 0.7);
  }

  TEST(ExpressionWords, WhatAnExpressionMayDependOn)
  {
    EXPECT_TRUE(may_depend_on("2*x + 1", "xyz"));
    EXPECT_FALSE(may_depend_on("2*x + exp(1)", "t"));
    EXPECT_FALSE(may_depend_on("3", "xyzt"));
    EXPECT_TRUE(may_depend_on("exact", "t"));
    EXPECT_TRUE(may_depend_on("", "t"));
    EXPECT_EQ(numbers_in("if(t/60 < 5.5e-1, x1, 2)"), (std::vector<double>{60, 0.55, 2}));
  }

  Scene slab()
  {
    Scene scene;
    scene.symmetry = Symmetry::planar;
    scene.domain.upper = {1, 0, 0};
    scene.boundaries[0] = scene.boundaries[1] = Boundary();
    scene.initial.temperature = Field::uniform(1.2);
    return scene;
  }

  Scene square()
  {
    Scene scene;
    scene.domain.shape = DomainShape::box;
    scene.domain.dimension = 2;
    scene.domain.upper = {1, 1, 0};
    for(int side = 0; side < 4; ++side)
      scene.boundaries[side] = Boundary();
    scene.initial.temperature = Field::uniform(0);
    return scene;
  }

  TEST(TemperatureBounds, ABodyAtRestKeepsThem)
  {
    for(const double temperature : {1.2, 300., -5e3})
    {
      Scene scene = slab();
      scene.initial.temperature = Field::uniform(temperature);
      const TemperatureBounds bounds = temperature_bounds(scene);
      EXPECT_EQ(bounds.lower, temperature);
      const double off = 1e-14 * std::abs(temperature);
      EXPECT_NO_THROW(
          check_temperature(bounds, temperature - off, temperature + off, "test", 1, 0));
      EXPECT_THROW(
          check_temperature(bounds, temperature, temperature + 1e6 * off, "test", 1, 0),
          NumericalError);
    }
  }

  TEST(TemperatureBounds, NarrowSpotsAreSeen)
  {
    Scene line = slab();
    line.initial.temperature
        = {"if(x > 0.51 & x < 0.512, 5, 1)", [](const Position &p, double)
           { return p[0] > 0.51 && p[0] < 0.512 ? 5. : 1.; }};
    EXPECT_EQ(temperature_bounds(line).upper, 5);
    Scene plane = square();
    plane.initial.temperature
        = {"if((x - 0.3)^2 + (y - 0.44)^2 < 1e-5, 5, 1)", [](const Position &p, double) {
             return std::pow(p[0] - 0.3, 2) + std::pow(p[1] - 0.44, 2) < 1e-5 ? 5. : 1.;
           }};
    EXPECT_EQ(temperature_bounds(plane).upper, 5);
  }

  TEST(TemperatureBounds, ShortPulsesOfFluxAndReleaseAreSeen)
  {
    Scene scene = slab();
    scene.boundaries[0] = Boundary{BoundaryKind::flux, pulse()};
    EXPECT_EQ(temperature_bounds(scene).lower, 1.2);
    EXPECT_TRUE(std::isinf(temperature_bounds(scene).upper));
    scene.boundaries[0] = Boundary();
    scene.volumetric_source = pulse();
    EXPECT_TRUE(std::isinf(temperature_bounds(scene).upper));
    scene.volumetric_source = Field::uniform(0);
    EXPECT_EQ(temperature_bounds(scene).upper, 1.2);
  }

  TEST(TemperatureBounds, ConstantsAndExactWallsCostFewCalls)
  {
    int calls = 0;
    Scene scene = square();
    const auto counted = [&calls](const Position &, double t)
    {
      ++calls;
      return std::cos(t);
    };
    for(int side = 0; side < 4; ++side)
      scene.boundaries[side]
          = Boundary{BoundaryKind::fixed_temperature, {"exact", counted}, true};
    scene.end_time = 20;
    const TemperatureBounds bounds = temperature_bounds(scene);
    EXPECT_LE(calls, 8000);
    EXPECT_NEAR(bounds.lower, -1, 5e-3);
    EXPECT_LE(bounds.lower, -1);
    EXPECT_GE(bounds.upper, 1);
  }

  TEST(Solutes, APocketOfSaltIsSeen)
  {
    Scene scene = slab();
    scene.alloy.emplace();
    scene.initial.concentration
        = {{"if(x > 0.705 & x < 0.725, 0.1, 0)", [](const Position &p, double)
            { return p[0] > 0.705 && p[0] < 0.725 ? 0.1 : 0.; }}};
    EXPECT_TRUE(initially_present(scene, 0));
    // No number tells where: dense sampling alone.
    scene.initial.concentration
        = {{"max(0, sin(x*x*pi) - cos(0))", [](const Position &p, double)
            { return std::abs(p[0] - std::sqrt(0.5)) < 2e-4 ? 0.1 : 0.; }}};
    EXPECT_TRUE(initially_present(scene, 0));
  }
} // namespace
