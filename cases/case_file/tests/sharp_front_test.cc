#include <cases/case_file/tests/sample_case.h>
#include <cases/effects.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  std::string about_annulus(const std::string &old_piece, const std::string &new_piece)
  {
    return complaint(replaced(annulus, old_piece, new_piece));
  }

  const std::string frank = "subsection Exact solution\n  set kind = frank\n"
                            "  set far temperature = -0.3\nend\n";

  /** A disk whose initial state and rim are those of growth into undercooled melt. */
  std::string undercooled_disk()
  {
    std::string text = replaced(annulus, "shape = shell", "shape = ball");
    text = replaced(text, "    set inner radius = 0.2\n", "");
    text = replaced(text,
                    "    subsection inner\n      set kind = fixed temperature\n"
                    "      set temperature = -0.21\n    end\n",
                    "");
    text = replaced(text, "set kind = insulated", "set kind = exact");
    const std::size_t from = text.find("    set temperature = if"),
                      to = text.find("  end\n  subsection Walls");
    text.replace(from, to - from, "    set kind = exact\n");
    text = replaced(text, "set end time", "set start time = 0.1\n  set end time");
    return replaced(text, "symmetry = none", "symmetry = cylindrical");
  }

  /** A bar that a flux freezes. */
  std::string bar()
  {
    std::string text
        = replaced(slab, "set kind = fixed temperature\n      set temperature = -10",
                   "set kind = flux\n      set flux = -100");
    text = replaced(text, "set temperature = 10",
                    "set temperature = 10 - 100/(2*0.591*0.1)*(0.1 - x)^2");
    return replaced(text, "end time = 100", "end time = 40000");
  }

  const std::string from_flux
      = "subsection Exact solution\n  set kind = oracle\n  set start = wall flux\nend\n";
} // namespace

TEST(SharpFront, AShellHasTwoWallsAndAFrontOfItsOwn)
{
  const Case c = read(annulus);
  const Domain &domain = c.scene.domain;
  EXPECT_EQ(domain.shape, DomainShape::shell);
  EXPECT_TRUE(domain.round());
  EXPECT_EQ(domain.inner_radius, 0.2);
  EXPECT_EQ(domain.radius, 1);
  EXPECT_EQ(domain.side(), 2);
  EXPECT_EQ(c.scene.sides(), (std::vector{Side::outer, Side::inner}));
  EXPECT_EQ(c.scene.boundary(Side::inner).value({}, 0), -0.21);
  ASSERT_TRUE(c.scene.initial.front.has_value());
  EXPECT_DOUBLE_EQ((*c.scene.initial.front)({0, 0.4, 0}, 0), -0.09);
  EXPECT_FALSE(effects_called_for(c.scene).contains(Effect::metastable_phase));
  EXPECT_FALSE(read(slab).scene.initial.front.has_value());
}

TEST(SharpFront, ShellsThatCannotBe)
{
  EXPECT_EQ(about_annulus("    set inner radius = 0.2\n", ""),
            "a.prm:5: key 'inner radius' in subsection 'Scene/Domain' is missing: a "
            "shell needs it");
  EXPECT_EQ(about_annulus("inner radius = 0.2", "inner radius = 1"),
            "a.prm:9: key 'inner radius' in subsection 'Scene/Domain' (1) must be less "
            "than 'radius' (1)");
  EXPECT_EQ(about_annulus("dimension = 2", "dimension = 1"),
            "a.prm:7: key 'dimension' in subsection 'Scene/Domain' must be 2 or 3 for a "
            "shell");
  EXPECT_EQ(about_annulus("symmetry = none", "symmetry = spherical"),
            "a.prm:3: key 'symmetry' in subsection 'Scene' contradicts the domain: a "
            "shell in 2 dimensions is cylindrical or none, not spherical");
  EXPECT_EQ(about_annulus("shape = shell", "shape = ball"),
            "a.prm:9: key 'inner radius' in subsection 'Scene/Domain' has no meaning "
            "here: the shape is a ball");
  EXPECT_EQ(about_annulus("subsection outer", "subsection x_max"),
            "a.prm:29: subsection 'Scene/Walls/x_max' names a wall that the domain "
            "lacks; its walls are inner, outer");
  EXPECT_EQ(about_annulus("kind = insulated", "kind = periodic"),
            "a.prm:30: key 'kind' in subsection 'Scene/Walls/outer' cannot be periodic: "
            "walls of a ball, a shell, an outline or a mesh face no other");
  EXPECT_EQ(about_annulus("  subsection Walls\n",
                          "  subsection Source 1\n    set position = 0, 0\n    set power "
                          "= 1\n  end\n  subsection Walls\n"),
            "a.prm:25: key 'position' in subsection 'Scene/Source 1' lies outside the "
            "domain");
  const std::string round
      = replaced(annulus, "symmetry = none", "symmetry = cylindrical");
  EXPECT_EQ(complaint(round), "no complaint");
  EXPECT_TRUE(complaint(replaced(round, "temperature = -0.21", "temperature = x"))
                  .starts_with("a.prm:27: key 'temperature' in subsection "
                               "'Scene/Walls/inner' contradicts the scene's cylindrical "
                               "symmetry: it ranges from -0.2 to 0.2"));
}

TEST(SharpFront, FrontsThatCannotBe)
{
  EXPECT_TRUE(about_annulus("front = x^2", "front = ln(x)")
                  .starts_with("a.prm:22: key 'front' in subsection 'Scene/Initial "
                               "state' is "));
  EXPECT_EQ(about_annulus("front = x^2", "front = z^2"),
            "a.prm:22: key 'front' in subsection 'Scene/Initial state' depends on z, "
            "which it may not here");
  EXPECT_TRUE(complaint(replaced(replaced(annulus, "= none", "= cylindrical"),
                                 "front = x^2", "front = x"))
                  .starts_with("a.prm:22: key 'front' in subsection 'Scene/Initial "
                               "state' contradicts the scene's cylindrical symmetry"));
  EXPECT_EQ(complaint(replaced(undercooled_disk() + frank, "set kind = exact\n  end",
                               "set kind = exact\n    set front = x\n  end")),
            "a.prm:22: key 'front' in subsection 'Scene/Initial state' has no meaning "
            "here: the initial state is the exact solution's");
  const std::string held = replaced(slab, "set kind = insulated", "set kind = exact");
  EXPECT_TRUE(
      complaint(replaced(held, "set temperature = 10",
                         "set temperature = 10\n    set front = 0.01 - x")
                + "subsection Exact solution\n  set kind = neumann\nend\n")
          .starts_with("a.prm:23: key 'front' in subsection 'Scene/Initial state' "
                       "contradicts the exact solution, which is liquid at x = "));
}

TEST(SharpFront, UndercooledLiquidCallsForATrackedFront)
{
  const Case c = read(undercooled_disk() + frank);
  const double front = c.exact->front(0.1);
  ASSERT_TRUE(c.scene.initial.front.has_value());
  EXPECT_NEAR((*c.scene.initial.front)({0, 0.5, 0}, 0.1), 0.5 - front, 1e-15);
  EXPECT_TRUE(effects_called_for(c.scene).contains(Effect::metastable_phase));
  const std::string on = "subsection Effects\n  set metastable_phase = on\nend\n";
  EXPECT_EQ(complaint(annulus + on), "no complaint");
  EXPECT_EQ(complaint(slab + on),
            "a.prm:35: key 'metastable_phase' in subsection 'Effects' is on but key "
            "'front' in subsection 'Scene/Initial state' is missing, which alone can "
            "leave a phase beyond the melting temperature");
}

/** Where liquid holds the origin the level set of an exact state is turned around. */
TEST(SharpFront, AnExactFrontIsNegativeInTheSolid)
{
  std::string text = replaced(slab, "    set temperature = 10", "    set kind = exact");
  text = replaced(text, "set kind = fixed temperature\n      set temperature = -10",
                  "set kind = exact");
  text = replaced(text, "set kind = insulated", "set kind = exact");
  text = replaced(text, "set end time", "set start time = 10\n  set end time");
  const Case c = read(text
                      + "subsection Exact solution\n  set kind = neumann\n"
                        "  set wall temperature = 10\n  set far temperature = -5\nend\n");
  ASSERT_FALSE(c.exact->solid_at_origin());
  EXPECT_GT((*c.scene.initial.front)({0, 0, 0}, 10), 0);
  EXPECT_LT((*c.scene.initial.front)({0.1, 0, 0}, 10), 0);
  EXPECT_FALSE(effects_called_for(c.scene).contains(Effect::metastable_phase));
}

TEST(SharpFront, WhatIsMeasuredAndHeldAgainst)
{
  const Case c = read(annulus
                      + "subsection Measure\n  set front mode = 4\n"
                        "  set intermediate times = 0.05, 0.1, 0.15, 0.19\nend\n"
                        "subsection Reference\n  set method = fem-fitted[degree=3]\n"
                        "  set n = 64\nend\n");
  EXPECT_EQ(c.measurement.front_mode, 4);
  EXPECT_EQ(c.measurement.intermediate_times, (std::vector{0.05, 0.1, 0.15, 0.19}));
  ASSERT_TRUE(c.reference.has_value());
  EXPECT_EQ(c.reference->label, "fem-fitted[degree=3]");
  EXPECT_EQ(c.reference->n, 64);
  EXPECT_FALSE(read(annulus).reference.has_value());
  EXPECT_EQ(read(annulus).measurement.front_mode, 0);
  EXPECT_TRUE(read(annulus).measurement.intermediate_times.empty());
}

TEST(SharpFront, MeasuresAndReferencesThatCannotBe)
{
  const auto measure = [](const std::string &text, const std::string &keys)
  { return complaint(text + "subsection Measure\n" + keys + "\nend\n"); };
  EXPECT_EQ(measure(annulus, "set intermediate times = 0.1, 0.05"),
            "a.prm:35: key 'intermediate times' in subsection 'Measure' must ascend "
            "between the "
            "scene's start (0) and its end (0.2), which 0.05 does not");
  EXPECT_EQ(measure(annulus, "set intermediate times = 0.2"),
            "a.prm:35: key 'intermediate times' in subsection 'Measure' must ascend "
            "between the "
            "scene's start (0) and its end (0.2), which 0.2 does not");
  EXPECT_EQ(measure(annulus, "set intermediate times = 1, 2, 3, 4, 5, 6, 7, 8, 9"),
            "a.prm:35: key 'intermediate times' in subsection 'Measure' needs one to "
            "eight numbers "
            "separated by commas, not '1, 2, 3, 4, 5, 6, 7, 8, 9'");
  EXPECT_EQ(measure(slab, "set front mode = 2"),
            "a.prm:35: key 'front mode' in subsection 'Measure' has no meaning here: "
            "only a disk or a shell in 2 dimensions without symmetry has modes");
  const auto reference = [](const std::string &text, const std::string &keys)
  { return complaint(text + "subsection Reference\n" + keys + "end\n"); };
  EXPECT_EQ(reference(annulus, "set n = 4\n"),
            "a.prm:34: key 'method' in subsection 'Reference' is missing: a reference is "
            "a method at a resolution");
  EXPECT_EQ(reference(annulus, "set method = fem-cut\n"),
            "a.prm:34: key 'n' in subsection 'Reference' is missing: a reference is a "
            "method at a resolution");
  EXPECT_EQ(reference(annulus, "set method = fem-cut[\nset n = 4\n"),
            "a.prm:35: key 'method' in subsection 'Reference' 'fem-cut[' is not a label: "
            "METHOD or METHOD[KEY=VALUE,KEY=VALUE]");
  EXPECT_EQ(
      reference(undercooled_disk() + frank, "set method = sph\nset n = 4\n").substr(10),
      "key 'method' in subsection 'Reference' has no meaning here: there is an "
      "exact solution");
}

TEST(SharpFront, AFluxBringsTheWallToTheMeltingPoint)
{
  const Case c = read(bar() + from_flux);
  EXPECT_EQ(c.exact->start_time(), 0);
  EXPECT_EQ(c.exact->front(1), 0);
  EXPECT_GT(c.exact->front(40000), 0.005);
  const double drawn
      = c.exact->heat_content(0, 0.1, 0) - c.exact->heat_content(0, 0.1, 40000);
  EXPECT_NEAR(drawn, 100 * 40000., 1e-4);
}

TEST(SharpFront, FluxesThatTheOracleCannotStartFrom)
{
  const std::string start = "in subsection 'Exact solution' ";
  EXPECT_NE(
      complaint(replaced(bar(), "flux = -100", "flux = -100*t") + from_flux)
          .find(start + "cannot be 'wall flux' but where x_min has the kind 'flux'"),
      std::string::npos);
  EXPECT_NE(complaint(slab + from_flux).find(start + "cannot be 'wall flux'"),
            std::string::npos);
  EXPECT_NE(complaint(replaced(bar(), "10 - 100/", "4 - 100/") + from_flux)
                .find("gives no solution: freezing under a flux: the wall starts at"),
            std::string::npos);
  EXPECT_NE(complaint(replaced(bar(), "(0.1 - x)^2", "(0.1 - x)^3") + from_flux)
                .find("contradicts the exact solution"),
            std::string::npos);
  EXPECT_NE(complaint(replaced(bar() + from_flux, "start = wall flux",
                               "start = wall flux\n  set start time = 3"))
                .find(start + "has no meaning here: the wall's flux decides"),
            std::string::npos);
}
