#include <cases/case_file/tests/sample_case.h>

#include <gtest/gtest.h>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  const std::string neumann = "subsection Exact solution\n  set kind = neumann\nend\n";

  /** The complaint about the slab with a piece replaced. */
  std::string about_slab(const std::string &old_piece, const std::string &new_piece)
  {
    return complaint(replaced(slab, old_piece, new_piece));
  }

  std::string about_square(const std::string &old_piece, const std::string &new_piece)
  {
    return complaint(replaced(square, old_piece, new_piece));
  }
} // namespace

TEST(BadCase, PropertiesThatCannotBe)
{
  EXPECT_EQ(about_slab("conductivity = 2.2", "conductivity = -2.2"),
            "a.prm:13: key 'conductivity' in subsection 'Scene/Material/Solid' needs a "
            "number greater than 0 (W/(m K)), not '-2.2'");
  EXPECT_EQ(about_slab("density = 1000", "density = 0"),
            "a.prm:15: key 'density' in subsection 'Scene/Material/Solid' needs a number "
            "greater than 0 (kg/m^3), not '0'");
  EXPECT_EQ(
      about_slab("latent heat = 333500", "latent heat = -1"),
      "a.prm:10: key 'latent heat' in subsection 'Scene/Material' needs a number of "
      "at least 0 (J/kg), not '-1'");
  EXPECT_EQ(
      about_slab("specific heat capacity = 2090", "specific heat capacity = big"),
      "a.prm:14: key 'specific heat capacity' in subsection "
      "'Scene/Material/Solid' needs a number greater than 0 (J/(kg K)), an expression "
      "of T or points 'T: value, ...', not 'big'");
  EXPECT_EQ(about_slab("      set density = 1000\n", ""),
            "a.prm:12: key 'density' in subsection 'Scene/Material/Solid' is missing: it "
            "needs a number greater than 0 (kg/m^3)");
}

TEST(BadCase, NumbersThatAreNoNormalOnes)
{
  for(const char *text : {"1e-320", "-1e-320"})
    EXPECT_EQ(about_slab("set end time = 100", std::string("set start time = ") + text
                                                   + "\n  set end time = 100"),
              std::string("a.prm:4: key 'start time' in subsection 'Scene' is ") + text
                  + ", nearer to zero than what can be computed with (2.22507e-308)");
}

TEST(BadCase, TimesAndDomains)
{
  EXPECT_EQ(
      about_slab("set end time = 100", "set end time = 100\n  set start time = 100"),
      "a.prm:4: key 'end time' in subsection 'Scene' (100) must come after 'start "
      "time' (100)");
  EXPECT_EQ(about_slab("    set length = 0.1\n", ""),
            "a.prm:5: key 'length' in subsection 'Scene/Domain' is missing: a slab needs "
            "it");
  EXPECT_EQ(about_slab("set length = 0.1", "set length = 0.1\n    set radius = 1"),
            "a.prm:8: key 'radius' in subsection 'Scene/Domain' has no meaning here: the "
            "shape is a slab");
  EXPECT_EQ(about_slab("set length = 0.1", "set length = 0.1\n    set dimension = 2"),
            "a.prm:8: key 'dimension' in subsection 'Scene/Domain' must be 1 for a slab");
  EXPECT_EQ(about_square("corner = 1, 1", "corner = 1, -1"),
            "a.prm:9: key 'upper corner' in subsection 'Scene/Domain' must exceed 'lower "
            "corner' in every coordinate");
  EXPECT_EQ(about_square("corner = 1, 1", "corner = 1"),
            "a.prm:9: key 'upper corner' in subsection 'Scene/Domain' needs 2 "
            "coordinates, not 1");
  EXPECT_EQ(about_square("    set dimension = 2\n", ""),
            "a.prm:5: key 'dimension' in subsection 'Scene/Domain' is missing: a box "
            "needs 2 or 3");
}

TEST(BadCase, ContradictorySymmetry)
{
  EXPECT_EQ(
      about_slab("symmetry = planar", "symmetry = spherical"),
      "a.prm:3: key 'symmetry' in subsection 'Scene' contradicts the domain: a slab "
      "in 1 dimension is planar, not spherical");
  EXPECT_EQ(about_square("symmetry = none", "symmetry = cylindrical"),
            "a.prm:3: key 'symmetry' in subsection 'Scene' contradicts the domain: a box "
            "in 2 dimensions is none, not cylindrical");
  std::string disk = replaced(square, "shape = box", "shape = ball");
  disk = replaced(disk, "    set lower corner = -1, -1\n    set upper corner = 1, 1\n",
                  "    set radius = 1\n");
  EXPECT_EQ(
      complaint(replaced(disk, "symmetry = none", "symmetry = spherical")),
      "a.prm:3: key 'symmetry' in subsection 'Scene' contradicts the domain: a ball "
      "in 2 dimensions is cylindrical or none, not spherical");
  disk = replaced(disk, "symmetry = none", "symmetry = cylindrical");
  EXPECT_EQ(complaint(disk), "no complaint");
  EXPECT_EQ(complaint(replaced(disk, "position = 0, 0", "position = 0.1, 0")),
            "a.prm:23: key 'position' in subsection 'Scene/Source 1' contradicts the "
            "cylindrical symmetry: it must be the origin");
  EXPECT_EQ(complaint(replaced(disk, "temperature = 10", "temperature = 10 + x")),
            "a.prm:20: key 'temperature' in subsection 'Scene/Initial state' contradicts "
            "the scene's cylindrical symmetry: it ranges from 9.75 to 10.25 at the "
            "distance 0.25");
  EXPECT_EQ(complaint(replaced(disk, "temperature = 10", "temperature = 10 + x^2 + y*y")),
            "no complaint");
}

TEST(BadCase, Walls)
{
  EXPECT_EQ(about_slab("      set temperature = -10\n", ""),
            "a.prm:25: key 'temperature' in subsection 'Scene/Walls/x_min' is missing: a "
            "wall of kind 'fixed temperature' needs it");
  EXPECT_EQ(
      about_slab("set kind = insulated", "set kind = flux"),
      "a.prm:29: key 'flux' in subsection 'Scene/Walls/x_max' is missing: a wall of "
      "kind 'flux' needs it");
  EXPECT_EQ(about_slab("set kind = insulated", "set flux = 3"),
            "a.prm:30: key 'flux' in subsection 'Scene/Walls/x_max' has no meaning here: "
            "the wall's kind is 'insulated'");
  EXPECT_EQ(about_slab("set kind = insulated", "set kind = isolated"),
            "a.prm:30: key 'kind' in subsection 'Scene/Walls/x_max' needs one of "
            "insulated, fixed temperature, exact, flux, periodic, heat transfer, "
            "radiation, not "
            "'isolated'; the "
            "nearest is 'insulated'");
  EXPECT_EQ(about_slab("set kind = insulated", "set kind = periodic"),
            "a.prm:30: key 'kind' in subsection 'Scene/Walls/x_max' is periodic but that "
            "of 'x_min' is not");
  EXPECT_EQ(
      about_slab("subsection x_max", "subsection y_max"),
      "a.prm:29: subsection 'Scene/Walls/y_max' names a wall that the domain lacks; "
      "its walls are x_min, x_max");
  EXPECT_EQ(about_slab("set temperature = -10", "set temperature = -10*sin(y)"),
            "a.prm:27: key 'temperature' in subsection 'Scene/Walls/x_min' depends on y, "
            "which it may not here");
  EXPECT_EQ(
      about_slab("set temperature = -10", "set temperature = ln(50 - t)"),
      "a.prm:27: key 'temperature' in subsection 'Scene/Walls/x_min' is -inf at x = "
      "0, t = 50");
  EXPECT_EQ(about_slab("set kind = insulated", "set kind = exact"),
            "a.prm:30: key 'kind' in subsection 'Scene/Walls/x_max' is 'exact' but the "
            "case has no exact solution (subsection 'Exact solution', key 'kind')");
}

TEST(BadCase, Sources)
{
  EXPECT_EQ(about_square("position = 0, 0", "position = 0, 1.5"),
            "a.prm:24: key 'position' in subsection 'Scene/Source 1' lies outside the "
            "domain");
  EXPECT_EQ(about_square("    set power = -100\n", ""),
            "a.prm:23: key 'power' in subsection 'Scene/Source 1' is missing: a source "
            "needs one");
  EXPECT_EQ(about_square("power = -100", "power = -100*x"),
            "a.prm:25: key 'power' in subsection 'Scene/Source 1' depends on x, which it "
            "may not here");
  EXPECT_EQ(about_square("power = -100", "power = exact"),
            "a.prm:25: key 'power' in subsection 'Scene/Source 1' is 'exact' but the "
            "exact solution is not that of a sink");
  EXPECT_EQ(about_slab("  subsection Walls\n",
                       "  subsection Source 2\n    set power = 1\n  end\n"
                       "  subsection Walls\n"),
            "a.prm:24: subsection 'Scene/Source 2' has no meaning in a slab; a line or "
            "point source needs a box, a ball or a shell");
}

TEST(BadCase, EffectsThatAreOnWithoutAnythingToActOn)
{
  const auto on = [](const std::string &text, const std::string &effect) {
    return complaint(with(text, "subsection Effects\n  set " + effect + " = on\nend\n"));
  };
  EXPECT_EQ(on(slab, "wall_flux"),
            "a.prm:35: key 'wall_flux' in subsection 'Effects' is on but no wall in "
            "subsection 'Scene/Walls' has the kind 'flux'");
  EXPECT_EQ(on(slab, "heat_sources"),
            "a.prm:35: key 'heat_sources' in subsection 'Effects' is on but there is no "
            "subsection 'Scene/Source 1'");
  EXPECT_EQ(on(slab, "phase_heat_capacity"),
            "a.prm:35: key 'phase_heat_capacity' in subsection 'Effects' is on but key "
            "'specific heat capacity' in subsection 'Scene/Material/Liquid' is missing");
  EXPECT_EQ(on(slab, "phase_conductivity"), "no complaint");
  EXPECT_NE(on(square, "wall_temperature"), "no complaint");
  EXPECT_NE(on(square, "liquid_motion"), "no complaint");
  EXPECT_EQ(on(square, "heat_sources"), "no complaint");
}

TEST(BadCase, ExactSolutionsThatDoNotSolveTheScene)
{
  const std::string held = replaced(slab, "set kind = insulated", "set kind = exact");
  EXPECT_EQ(complaint(with(held, neumann)), "no complaint");
  EXPECT_EQ(
      complaint(with(slab, "subsection Exact solution\n  set kind = neumann\n"
                           "  set wall temperature = -12\nend\n")),
      "a.prm:27: key 'temperature' in subsection 'Scene/Walls/x_min' contradicts "
      "the exact solution, whose temperature is -12 and not -10 at x = 0, t = 6.25; "
      "a solution that holds approximately needs 'front floor' in subsection "
      "'Measure'");
  EXPECT_EQ(complaint(with(held, "subsection Exact solution\n  set kind = neumann\n"
                                 "  set far temperature = 11\nend\n"))
                .substr(0, 106),
            "a.prm:22: key 'temperature' in subsection 'Scene/Initial state' contradicts "
            "the exact solution, whose temp");
  const std::string late = replaced(slab, "set end time = 100", "set end time = 100000");
  const std::string message = complaint(with(late, neumann));
  EXPECT_TRUE(message.starts_with("a.prm:30: key 'kind' in subsection "
                                  "'Scene/Walls/x_max' contradicts the exact solution, "
                                  "whose heat flux is"))
      << message;
  EXPECT_EQ(complaint(with(late, neumann
                                     + "subsection Measure\n  set front floor = 1e-3\n"
                                       "end\n")),
            "no complaint");
}

TEST(BadCase, ExactSolutionsThatCannotBe)
{
  const auto exact = [](const std::string &text, const std::string &keys)
  { return complaint(with(text, "subsection Exact solution\n" + keys + "end\n")); };
  EXPECT_TRUE(
      exact(slab, "set kind = neumann\nset far temperature = -1\n")
          .starts_with("a.prm:35: key 'kind' in subsection 'Exact solution' gives "
                       "no solution: "));
  EXPECT_EQ(exact(slab, "set kind = line sink\nset lambda = 0.1\n"),
            "a.prm:35: key 'kind' in subsection 'Exact solution' contradicts the domain: "
            "'line sink' does not solve a planar scene in 1 dimension");
  EXPECT_EQ(exact(square, "set kind = line sink\n"),
            "a.prm:28: key 'lambda' in subsection 'Exact solution' is missing: the "
            "solution of a sink needs it");
  EXPECT_EQ(
      exact(square, "set kind = oracle\n"),
      "a.prm:29: key 'kind' in subsection 'Exact solution' cannot be 'oracle' for a "
      "scene without symmetry");
  EXPECT_EQ(exact(slab, "set kind = oracle\n"),
            "a.prm:34: key 'start time' in subsection 'Exact solution' is missing: an "
            "oracle that starts from a similarity solution needs it");
  EXPECT_EQ(exact(slab, "set kind = oracle\nset start time = 200\n"),
            "a.prm:36: key 'start time' in subsection 'Exact solution' must come before "
            "the scene's end");
  EXPECT_EQ(exact(slab, "set start time = 200\n"),
            "a.prm:35: key 'start time' in subsection 'Exact solution' has no meaning "
            "here: it is a key of the oracle");
  EXPECT_EQ(exact(slab, "set lambda = 0.2\n"),
            "a.prm:35: key 'lambda' in subsection 'Exact solution' has no meaning here: "
            "there is no exact solution");
  const std::string held = replaced(slab, "set kind = insulated", "set kind = exact");
  EXPECT_EQ(exact(held, "set kind = oracle\nset start time = 1\n"),
            "a.prm:30: key 'kind' in subsection 'Scene/Walls/x_max' cannot be 'exact' "
            "where the exact solution is the oracle, which takes its walls from the "
            "scene");
}

TEST(BadCase, MeasuresAndLists)
{
  EXPECT_EQ(complaint(with(slab, "subsection Measure\n  set samples = 20\nend\n")),
            "a.prm:35: key 'samples' in subsection 'Measure' must be at least 50, or 0 "
            "for every step: fewer times do not average over a front that moves inside a "
            "cell");
  EXPECT_EQ(complaint(with(slab, "subsection Measure\n  set temperature from = 2\n  set "
                                 "temperature to = 1\nend\n")),
            "a.prm:36: key 'temperature to' in subsection 'Measure' must exceed "
            "'temperature from'");
  EXPECT_EQ(complaint(with(slab, "subsection Measure\n  set front floor = 1\nend\n")),
            "a.prm:35: key 'front floor' in subsection 'Measure' has no meaning here: "
            "there is no exact solution");
  EXPECT_EQ(complaint(with(slab, "subsection Acceptance\n  set criterion 1 = sph: x at "
                                 "n=4\nend\n")),
            "a.prm:35: key 'criterion 1' in subsection 'Acceptance' 'sph: x at n=4' "
            "cannot be read: '<=', '>=', 'in' or 'within' is wanted at its end");
  EXPECT_EQ(complaint(with(slab, "subsection Printed\n  set value 1 = sph: x at n=4 = "
                                 "1\nend\n")),
            "a.prm:34: key 'source' in subsection 'Printed' is missing: printed values "
            "need the paper they are from");
  EXPECT_EQ(about_slab("set title = A slab", "set tags = a"),
            "a.prm:1: key 'title' at the top level is missing: every case has one");
}
