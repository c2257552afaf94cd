#include <cases/case_file/case_file.h>
#include <cases/case_file/tests/sample_case.h>
#include <cases/effects.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  std::string about(const std::string &text, const std::string &old_piece,
                    const std::string &new_piece)
  {
    return complaint(replaced(text, old_piece, new_piece));
  }

  bool holds(const std::string &text, const std::string &piece)
  {
    return text.find(piece) != std::string::npos;
  }

  const std::string moving
      = replaced(square, "position = 0, 0", "position = max(-0.5, t/1000 - 0.5), 0.1");

  const std::string turned
      = replaced(replaced(square, "set shape = box", "set shape = axisymmetric"),
                 "lower corner = -1, -1", "lower corner = 0, -1");

  const std::string spot = replaced(turned, "set position = 0, 0",
                                    "set position = 0, t/2000\n    set radius = 0.1");
} // namespace

TEST(SourceCase, MovesAlongAnExpressionOfTime)
{
  const Scene scene = read(moving).scene;
  const PointSource &source = scene.sources.at(0);
  ASSERT_TRUE(source.path);
  EXPECT_EQ(source.position, (Position{-0.5, 0.1, 0}));
  EXPECT_EQ(source.at(500), (Position{0, 0.1, 0}));
  const EffectSet effects = effects_called_for(scene);
  EXPECT_TRUE(effects.contains(Effect::moving_source));
  Scene at_rest = scene;
  at_rest.effect_choices[Effect::moving_source] = EffectChoice::off;
  EXPECT_EQ(simulated_scene(at_rest, effects_called_for(at_rest)).sources[0].at(500),
            source.position);
  EXPECT_FALSE(effects_called_for(read(square).scene).contains(Effect::moving_source));
}

TEST(SourceCase, AGaussianSpotIsHeatReleasedThroughout)
{
  const Scene scene = read(spot).scene;
  EXPECT_TRUE(scene.sources.empty());
  ASSERT_TRUE(scene.volumetric_source);
  const double peak = -100 / std::pow(std::numbers::pi * 0.01, 1.5);
  EXPECT_NEAR((*scene.volumetric_source)({0, 0.25, 0}, 500), peak, 1e-9 * std::abs(peak));
  EXPECT_NEAR((*scene.volumetric_source)({0.1, 0.25, 0}, 500), peak / std::numbers::e,
              1e-9 * std::abs(peak));
  const Scene plane
      = read(replaced(square, "position = 0, 0", "position = 0, 0\n    set radius = 0.1"))
            .scene;
  EXPECT_NEAR((*plane.volumetric_source)({0, 0, 0}, 0), -100 / (std::numbers::pi * 0.01),
              1e-6);
}

TEST(SourceCase, WhatCannotBeIsRefused)
{
  EXPECT_TRUE(holds(about(moving, "t/1000 - 0.5", "t/100 - 0.5"),
                    "lies outside the domain at t = "));
  EXPECT_TRUE(holds(about(square, "position = 0, 0", "position = 0"),
                    "needs 2 coordinates, not 1"));
  EXPECT_TRUE(holds(about(square, "position = 0, 0", "position = x, 0"), "depends on x"));
  EXPECT_TRUE(holds(about(spot, "position = 0, t", "position = 0.5, t"), "on the axis"));
  EXPECT_TRUE(holds(about(spot, "    set radius = 0.1\n", ""), "needs a 'radius'"));
}

TEST(AxisymmetricCase, IsAHalfSection)
{
  const Scene scene = read(spot).scene;
  EXPECT_EQ(scene.domain.shape, DomainShape::axisymmetric);
  EXPECT_TRUE(scene.domain.rectangular());
  EXPECT_EQ(scene.sides().size(), 4u);
  EXPECT_TRUE(holds(about(spot, "corner = 0, -1", "corner = -1, -1"), "beyond the axis"));
  EXPECT_TRUE(holds(about(spot, "dimension = 2", "dimension = 3"), "must be 2"));
  EXPECT_TRUE(holds(about(spot, "symmetry = none", "symmetry = cylindrical"),
                    "contradicts the domain"));
  EXPECT_TRUE(
      holds(about(spot, "  subsection Initial",
                  "  subsection Walls\n    subsection x_min\n      set kind = fixed "
                  "temperature\n      set temperature = 1\n    end\n  end\n"
                  "  subsection Initial"),
            "it is the axis"));
}
