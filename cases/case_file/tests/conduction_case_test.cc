#include <cases/case_file/case_file.h>
#include <cases/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace meltfront::cases;

namespace
{
  const std::string steady = R"(set title = A steady square
subsection Scene
  set symmetry = none
  set problem = poisson
  subsection Domain
    set shape = box
    set dimension = 2
    set lower corner = 0, 0
    set upper corner = 1, 1
  end
  subsection Material
    subsection Solid
      set conductivity = 2
    end
  end
  subsection Volumetric source
    set power density = 4 * pi^2 * sin(pi*x) * sin(pi*y)
  end
  subsection Walls
    subsection x_min
      set kind = heat transfer
      set ambient temperature = -2 * pi * sin(pi*y)
      set heat transfer coefficient = 1
    end
    subsection x_max
      set kind = exact
    end
    subsection y_min
      set kind = fixed temperature
      set temperature = 0
    end
    subsection y_max
      set kind = flux
      set flux = -2 * pi * sin(pi*x)
    end
  end
end
subsection Exact solution
  set kind = formula
  set temperature = sin(pi*x) * sin(pi*y)
end
)";

  std::string replaced(std::string text, const std::string &what, const std::string &with)
  {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
  }

  std::string complaint(const std::string &text)
  {
    try
    {
      read_case_text(text, "a.prm");
      return "no complaint";
    }
    catch(const InputError &error)
    {
      return error.what();
    }
  }
} // namespace

TEST(ConductionCase, ASteadySceneAndItsFormula)
{
  const Case c = read_case_text(steady, "a.prm");
  const Scene &scene = c.scene;
  EXPECT_EQ(scene.problem, ProblemKind::poisson);
  EXPECT_FALSE(scene.changes_phase());
  EXPECT_EQ(scene.start_time, 0);
  EXPECT_EQ(scene.end_time, 1);
  EXPECT_EQ(scene.conductivity_at({0.5, 0.5, 0}), 2);
  ASSERT_TRUE(scene.volumetric_source.has_value());
  EXPECT_NEAR((*scene.volumetric_source)({0.5, 0.5, 0}, 0), 4 * M_PI * M_PI, 1e-12);
  const Boundary &exchange = scene.boundary(Side::x_min);
  EXPECT_EQ(exchange.kind, BoundaryKind::heat_transfer);
  EXPECT_EQ(exchange.heat_transfer_coefficient, 1);
  EXPECT_NEAR(scene.boundary(Side::x_max).value({1, 0.5, 0}, 0), 0, 1e-15);
  EXPECT_FALSE(c.exact->has_front());
  EXPECT_NEAR(c.exact->temperature(Position{0.5, 0.25, 0}, 1), std::sqrt(0.5), 1e-15);
  const EffectSet effects = effects_called_for(scene);
  for(const Effect effect : {Effect::volumetric_source, Effect::robin_wall,
                             Effect::wall_flux, Effect::wall_temperature})
    EXPECT_TRUE(effects.contains(effect)) << to_string(effect);
  EXPECT_FALSE(effects.contains(Effect::inclusion));
  EXPECT_FALSE(effects.contains(Effect::phase_change));
}

TEST(ConductionCase, WhatIsTakenOutIsGone)
{
  Case c = read_case_text(steady, "a.prm");
  for(const Effect effect : {Effect::volumetric_source, Effect::robin_wall})
    c.scene.effect_choices[effect] = EffectChoice::off;
  const Scene scene = simulated_scene(c.scene, effects_called_for(c.scene));
  EXPECT_FALSE(scene.volumetric_source.has_value());
  EXPECT_EQ(scene.boundary(Side::x_min).kind, BoundaryKind::insulated);
}

TEST(ConductionCase, AnInclusionConductsOtherwise)
{
  const std::string text = replaced(
      replaced(steady, "  subsection Walls",
               "  subsection Inclusion\n    set level set = x - 0.5\n    set "
               "conductivity = 7\n  end\n  subsection Walls"),
      "subsection Exact solution",
      "subsection Measure\n  set front floor = 1\nend\nsubsection Exact solution");
  const Scene scene = read_case_text(text, "a.prm").scene;
  EXPECT_EQ(scene.conductivity_at({0.25, 0, 0}), 7);
  EXPECT_EQ(scene.conductivity_at({0.75, 0, 0}), 2);
  EXPECT_TRUE(effects_called_for(scene).contains(Effect::inclusion));
}

TEST(ConductionCase, Complaints)
{
  EXPECT_EQ(complaint(steady), "no complaint");
  EXPECT_EQ(
      complaint(replaced(steady, "set problem = poisson",
                         "set problem = poisson\n  set end time = 1")),
      "a.prm:5: key 'end time' in subsection 'Scene' has no meaning here: the scene is "
      "steady");
  EXPECT_EQ(complaint(replaced(steady, "    subsection Solid\n",
                               "    set latent heat = 1\n    subsection Solid\n")),
            "a.prm:12: key 'latent heat' in subsection 'Scene/Material' has no meaning "
            "here: the scene is steady");
  EXPECT_NE(complaint(replaced(steady, "set flux = -2", "set flux = -3"))
                .find("contradicts the exact solution, whose heat flux is"),
            std::string::npos);
  EXPECT_NE(
      complaint(replaced(steady, "ambient temperature = -2", "ambient temperature = 2"))
          .find("contradicts the exact solution, whose heat flux is"),
      std::string::npos);
  EXPECT_EQ(
      complaint(replaced(steady, "      set heat transfer coefficient = 1\n", "")),
      "a.prm:20: key 'heat transfer coefficient' in subsection 'Scene/Walls/x_min' is "
      "missing: a wall of kind 'heat transfer' needs it");
  EXPECT_NE(
      complaint(
          replaced(steady, "set kind = formula\n", "set kind = five-point lattice\n"))
          .find("key 'temperature' in subsection 'Exact solution' has no meaning here"),
      std::string::npos);
  EXPECT_NE(complaint(replaced(replaced(steady, "set kind = formula\n",
                                        "set kind = five-point lattice\n"),
                               "  set temperature = sin(pi*x) * sin(pi*y)\n", ""))
                .find("cannot be 'five-point lattice' but for a steady square"),
            std::string::npos);
}
