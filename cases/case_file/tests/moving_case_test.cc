#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <cases/shape.h>
#include <cases/velocity_field.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

using namespace meltfront::cases;

namespace
{
  const std::string particle_scene = R"(
set title = A heated solid
set units = normalised
subsection Scene
  set problem = particle solid
  set end time = 10
  subsection Particle solid
    set arrangement = table 1
    set gravity = 32
    set disturbance = 1e-6
    subsection Base
      set restitution = 0.1
    end
    subsection Heating
      set position = 0.2, 5.7
      set stages = 50000 x 0.008, 30000 x 0.0095, 20000 x 0.015
      set power = -2
    end
  end
end
)";

  const std::string interface_scene = R"(
set title = A disk in a vortex
set units = normalised
subsection Scene
  set problem = interface advection
  set end time = 8
  subsection Domain
    set shape = box
    set dimension = 2
    set lower corner = 0, 0
    set upper corner = 1, 1
  end
  subsection Region
    set kind = ball
    set centre = 0.5, 0.75
    set radius = 0.15
  end
  subsection Velocity
    set kind = vortex
    set period = 8
  end
end
)";

  std::string replaced(std::string text, const std::string &from, const std::string &to)
  {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  std::string complaint(const std::string &text)
  {
    try
    {
      read_case_text(text, "x.prm");
    }
    catch(const InputError &error)
    {
      return error.what();
    }
    return "none";
  }

  void expect_complaint(const std::string &text, const std::string &part)
  {
    const std::string found = complaint(text);
    EXPECT_NE(found.find(part), std::string::npos) << found;
    EXPECT_TRUE(found.starts_with("x.prm:")) << found;
  }
} // namespace

TEST(ParticleSolidCase, IsRead)
{
  const Case c = read_case_text(particle_scene, "x.prm");
  EXPECT_EQ(c.scene.problem, ProblemKind::particle_solid);
  ASSERT_TRUE(c.scene.particle_solid);
  const ParticleSolid &solid = *c.scene.particle_solid;
  EXPECT_EQ(solid.table, 1);
  EXPECT_EQ(solid.gravity, 32);
  ASSERT_TRUE(solid.base);
  EXPECT_FALSE(solid.base->hot);
  ASSERT_TRUE(solid.heating);
  ASSERT_EQ(solid.heating->stages.size(), 3u);
  EXPECT_EQ(solid.heating->stages[1].steps, 30000);
  EXPECT_EQ(solid.heating->stages[1].strength, 0.0095);
  EXPECT_EQ(solid.heating->power, -2);
  EXPECT_FALSE(c.scene.changes_phase());
}

TEST(ParticleSolidCase, CallsForItsOwnEffectsOnly)
{
  const Case c = read_case_text(particle_scene, "x.prm");
  const EffectSet effects = effects_called_for(c.scene);
  EXPECT_EQ(effects.decisions().size(), 7u);
  EXPECT_TRUE(effects.contains(Effect::gravity));
  EXPECT_TRUE(effects.contains(Effect::point_heating));
  EXPECT_FALSE(effects.contains(Effect::hot_base));
  const Case off = read_case_text(
      particle_scene + "subsection Effects\n set point_heating = off\nend\n", "x.prm");
  const EffectSet fewer = effects_called_for(off.scene);
  EXPECT_FALSE(simulated_scene(off.scene, fewer).particle_solid->heating);
  EXPECT_TRUE(simulated_scene(off.scene, fewer).particle_solid->base);
}

TEST(ParticleSolidCase, SaysWhatIsWrong)
{
  expect_complaint(replaced(particle_scene, "30000 x", "30000 *"), "'30000 * 0.0095'");
  expect_complaint(replaced(particle_scene, "set position = 0.2, 5.7", ""), "position");
  expect_complaint(replaced(particle_scene, "table 1", "bar"), "must be a bar");
  expect_complaint(replaced(particle_scene, "set gravity = 32", "set rows = 5"),
                   "neither rectangle");
  expect_complaint(
      replaced(particle_scene, "set gravity = 32", "set repulsion exponent = 3"),
      "attraction exponent");
  expect_complaint(
      replaced(particle_scene, "set restitution = 0.1", "set hot slope = 0.1"),
      "hot half width");
  expect_complaint(replaced(particle_scene, "  set end time = 10\n",
                            "  set end time = 10\n  subsection Material\n    set latent "
                            "heat = 1\n  end\n"),
                   "has no meaning where the problem is 'particle solid'");
}

TEST(ParticleSolidCase, ReadsBathsLightCellsAndStages)
{
  const std::string open = "    set gravity = 32\n";
  const std::string in_a_bath = replaced(
      replaced(particle_scene, "table 1",
               "outline\n    set outline = 1 + 0.2*cos(3*phi)"),
      open,
      "    set initial temperature = 20\n    set drag = 2\n    set stages = 4, 10\n"
      "    subsection Bath\n      set temperatures = 50, 10\n      set times = 0, 5\n"
      "    end\n    subsection Light\n      set direction = 0, -2\n      set power = 3\n"
      "    end\n");
  const Case c = read_case_text(in_a_bath, "x.prm");
  const ParticleSolid &solid = *c.scene.particle_solid;
  EXPECT_EQ(solid.arrangement, SolidArrangement::outline);
  EXPECT_NEAR(solid.outline(0), 1.2, 1e-15);
  EXPECT_EQ(solid.initial_temperature, 20);
  EXPECT_EQ(solid.stages, (std::vector<double>{4, 10}));
  ASSERT_TRUE(solid.bath && solid.light);
  EXPECT_EQ(solid.bath->temperatures, (std::vector<double>{50, 10}));
  EXPECT_TRUE(solid.light->parallel);
  EXPECT_EQ(solid.light->at, (Position{0, -2, 0}));
  const EffectSet effects = effects_called_for(c.scene);
  for(const Effect effect : {Effect::drag, Effect::heat_bath, Effect::light})
    EXPECT_TRUE(effects.contains(effect)) << to_string(effect);
  const Case off = read_case_text(in_a_bath
                                      + "subsection Effects\n set light = off\n set "
                                        "heat_bath = off\n set drag = off\nend\n",
                                  "x.prm");
  const Scene dark = simulated_scene(off.scene, effects_called_for(off.scene));
  EXPECT_FALSE(dark.particle_solid->light || dark.particle_solid->bath
               || dark.particle_solid->drag > 0);

  expect_complaint(replaced(in_a_bath, "times = 0, 5", "times = 0, 5, 6"),
                   "a time for each of the 2 temperatures");
  expect_complaint(replaced(in_a_bath, "times = 0, 5", "times = 1, 5"), "begin with 0");
  expect_complaint(replaced(in_a_bath, "times = 0, 5", "times = 0, 0"), "ascend");
  expect_complaint(replaced(in_a_bath, "set direction = 0, -2\n", ""),
                   "one of 'position'");
  expect_complaint(replaced(in_a_bath, "direction = 0, -2", "direction = 0, 0"),
                   "no length");
  expect_complaint(replaced(in_a_bath, "stages = 4, 10", "stages = 4, 11"),
                   "after the end time");
  expect_complaint(replaced(in_a_bath, "set drag = 2", "set cell = 40, 0"),
                   "open space only");
  expect_complaint(replaced(in_a_bath, "cos(3*phi)", "2*cos(3*phi)*3"), "outline");
  expect_complaint(
      replaced(in_a_bath, "outline = 1", "settled = false\n    set outline = 1"),
      "laid to rest");
}

TEST(ParticleSolidCase, ReadsSolidsOfSpace)
{
  const std::string ball
      = replaced(replaced(particle_scene, "table 1", "ball"), "    set gravity = 32\n",
                 "    set cell = 40, 0, 40\n    set shifted = true\n");
  const Case c = read_case_text(ball, "x.prm");
  EXPECT_EQ(c.scene.domain.dimension, 3);
  EXPECT_EQ(c.scene.particle_solid->dimension(), 3);
  EXPECT_TRUE(c.scene.particle_solid->law.shifted);
  EXPECT_EQ(c.scene.particle_solid->cell, (std::vector<double>{40, 0, 40}));
  expect_complaint(replaced(ball, "cell = 40, 0, 40", "cell = 40, 0"), "3 lengths");
  expect_complaint(replaced(ball, "cell = 40, 0, 40", "cell = 40, 40, 40"),
                   "across the base");
  expect_complaint(replaced(ball, "set shifted = true", "set phase test = order"),
                   "crystals of the plane only");
  expect_complaint(replaced(ball, "ball", "table 1\n    set initial temperature = 3"),
                   "a table holds");
}

TEST(InterfaceCase, IsRead)
{
  const Case c = read_case_text(interface_scene, "x.prm");
  ASSERT_TRUE(c.scene.interface);
  EXPECT_NEAR(c.scene.interface->shape->signed_distance({0.5, 0.75, 0}), 0.15, 1e-15);
  EXPECT_NEAR(c.scene.interface->velocity->velocity({0.5, 0.25, 0}, 0, 2)[0], -1, 1e-12);
  EXPECT_TRUE(effects_called_for(c.scene).decisions().empty());
}

TEST(InterfaceCase, TakesFormulasForAVelocity)
{
  const Case c = read_case_text(
      replaced(interface_scene, "set kind = vortex\n    set period = 8",
               "set kind = formula\n    set x component = -y\n    set y component = x+t"),
      "x.prm");
  const Position u = c.scene.interface->velocity->velocity({2, 3, 0}, 5, 2);
  EXPECT_NEAR(u[0], -3, 1e-12);
  EXPECT_NEAR(u[1], 7, 1e-12);
}

TEST(InterfaceCase, SaysWhatIsWrong)
{
  expect_complaint(replaced(interface_scene, "set period = 8", ""), "period");
  expect_complaint(replaced(interface_scene, "kind = vortex", "kind = deformation"),
                   "dimensions");
  expect_complaint(replaced(interface_scene, "set radius = 0.15", "set front = 0.15"),
                   "radius");
  expect_complaint(replaced(interface_scene, "kind = ball", "kind = slotted disk"),
                   "slot width");
}
