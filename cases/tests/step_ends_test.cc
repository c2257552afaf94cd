#include <cases/error.h>
#include <cases/scene.h>
#include <cases/step_ends.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace
{
  using namespace meltfront::cases;

  /** A slab at -1 for 1 s, whose left wall has a temperature that varies. */
  Scene slab(Field temperature, BoundaryKind kind = BoundaryKind::fixed_temperature)
  {
    Scene scene;
    scene.symmetry = Symmetry::planar;
    scene.domain.shape = DomainShape::slab;
    scene.domain.upper = {1, 0, 0};
    scene.initial.temperature = Field::uniform(-1);
    scene.boundaries[static_cast<int>(Side::x_min)]
        = Boundary{kind, std::move(temperature)};
    scene.boundaries[static_cast<int>(Side::x_max)] = Boundary();
    return scene;
  }

  Field in_time(std::function<double(double)> value)
  {
    return {"sin(t)",
            [value = std::move(value)](const Position &, double t) { return value(t); }};
  }

  Field swing(double periods, double amplitude = 1)
  {
    return in_time([=](double t)
                   { return amplitude * std::sin(2 * std::numbers::pi * periods * t); });
  }

  /** By how much a wall departs from straight lines between the ends of steps, at most.
   */
  double largest_departure(const Field &field, std::vector<double> ends)
  {
    ends.insert(ends.begin(), 0);
    ends.push_back(1);
    double largest = 0;
    for(std::size_t i = 0; i + 1 < ends.size(); ++i)
      for(const double share : {0.25, 0.5, 0.75})
      {
        const auto at
            = [&](double s) { return field({}, ends[i] + s * (ends[i + 1] - ends[i])); };
        largest = std::max(largest,
                           std::abs(at(share) - (1 - share) * at(0) - share * at(1)));
      }
    return largest;
  }
} // namespace

TEST(StepEnds, FollowSwingsOfAnyNumberUpToTheirShareOfTheRange)
{
  // With as many periods as steps, or as samples of the search, the wall looks constant.
  for(const double periods : {5., 37.3, 64., 100., 320., 1000., 4096.})
    for(const int n : {10, 40, 160})
    {
      const Field wall = swing(periods);
      const auto ends = step_ends(slab(wall), n, 1);
      ASSERT_FALSE(ends.empty());
      ASSERT_TRUE(std::ranges::is_sorted(ends));
      ASSERT_GT(ends.front(), 0);
      ASSERT_LT(ends.back(), 1);
      // The range is 2, and a step departs by a quarter of it over n.
      EXPECT_LT(largest_departure(wall, ends), 2 * 0.5 / n) << periods << " " << n;
      const double per_period = double(ends.size()) / periods;
      EXPECT_GT(per_period, 2.5 * std::sqrt(n)) << periods << " " << n;
      EXPECT_LT(per_period, 5 * std::sqrt(n)) << periods << " " << n;
    }
}

TEST(StepEnds, StepsThatAreShortEnoughAreLeftAlone)
{
  EXPECT_TRUE(step_ends(slab(swing(1)), 40, 0.01).empty());
  EXPECT_TRUE(step_ends(slab(swing(100, 1e-6)), 40, 0.01).empty());
  EXPECT_TRUE(step_ends(slab(swing(100)), 40, 1e-5).empty());
  EXPECT_TRUE(step_ends(slab(Field::uniform(3)), 40, 0.01).empty());
  EXPECT_TRUE(step_ends(slab(swing(100), BoundaryKind::flux), 40, 0.01).empty());
  EXPECT_FALSE(
      step_ends(slab(swing(100), BoundaryKind::heat_transfer), 40, 0.01).empty());
}

TEST(StepEnds, AreWhereTheWallSwings)
{
  const Field burst = in_time(
      [](double t)
      {
        return std::sin(2000 * std::numbers::pi * t)
               * std::exp(-std::pow((t - 0.4) / 0.03, 2));
      });
  const auto ends = step_ends(slab(burst), 40, 0.01);
  ASSERT_FALSE(ends.empty());
  EXPECT_GT(ends.front(), 0.25);
  EXPECT_LT(ends.back(), 0.55);
  EXPECT_LT(largest_departure(burst, ends), 0.02);
}

TEST(StepEnds, FollowASpotThatMovesAlongAWall)
{
  Scene scene = slab(Field::uniform(0));
  scene.symmetry = Symmetry::none;
  scene.domain.shape = DomainShape::box;
  scene.domain.dimension = 2;
  scene.domain.upper = {1, 1, 0};
  scene.boundaries[static_cast<int>(Side::y_min)] = Boundary();
  scene.boundaries[static_cast<int>(Side::y_max)] = Boundary();
  scene.boundaries[static_cast<int>(Side::x_min)]->value
      = {"exp(-((y - t)/0.02)^2)", [](const Position &p, double t)
         { return std::exp(-std::pow((p[1] - t) / 0.02, 2)); }};
  const auto ends = step_ends(scene, 50, 0.02);
  for(std::size_t i = 1; i < ends.size(); ++i)
    EXPECT_LT(ends[i] - ends[i - 1], 0.006) << ends[i];
}

TEST(StepEnds, KeepBreakpointsAndEnclosedJumpsThatHaveNone)
{
  Field jump = in_time([](double t) { return t < 0.3 ? 0. : 1.; });
  const auto around = step_ends(slab(jump), 40, 0.01);
  ASSERT_FALSE(around.empty());
  EXPECT_LT(*std::ranges::min_element(around), 0.3);
  EXPECT_GT(*std::ranges::max_element(around), 0.3);
  EXPECT_NEAR(around.front(), 0.3, 1e-5);
  EXPECT_NEAR(around.back(), 0.3, 1e-5);
  jump.breakpoints = {0.3};
  EXPECT_EQ(step_ends(slab(jump), 40, 0.01), std::vector<double>{0.3});
}

TEST(StepEnds, FollowWhatJumpsSoonAgain)
{
  constexpr int halves = 512;
  Field square = in_time([](double t) { return int(halves * t) % 2 == 0 ? 1. : -1.; });
  for(int i = 1; i < halves; ++i)
    square.breakpoints.push_back(double(i) / halves);
  for(const int n : {10, 40, 160})
  {
    const auto ends = step_ends(slab(square), n, 0.01);
    // The first half is no jump.
    EXPECT_NEAR(double(ends.size()) / (halves - 1), std::ceil(2 * std::sqrt(n)), 0.01);
    for(const double time : square.breakpoints)
      EXPECT_TRUE(std::ranges::binary_search(ends, time));
  }
}

TEST(StepEnds, WhatCannotBeSampledIsRefused)
{
  EXPECT_THROW(step_ends(slab(swing(1.234e7)), 40, 0.01), Refusal);
}

TEST(StepEnds, TheLongestEqualStepsFollowTheFastestSwing)
{
  const double fast = longest_step_of_walls(slab(swing(100)), 40);
  EXPECT_NEAR(1 / (100 * fast), std::numbers::pi * std::sqrt(40.),
              0.1 * std::numbers::pi * std::sqrt(40.));
  EXPECT_NEAR(longest_step_of_walls(slab(swing(200)), 40) / fast, 0.5, 0.02);
  EXPECT_NEAR(longest_step_of_walls(slab(swing(100)), 160) / fast, 0.5, 0.02);
  EXPECT_EQ(longest_step_of_walls(slab(Field::uniform(1)), 40),
            std::numeric_limits<double>::infinity());
}
