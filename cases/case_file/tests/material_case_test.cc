#include <cases/case_file/case_file.h>
#include <cases/case_file/tests/sample_case.h>
#include <cases/effects.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  const std::string varying = replaced(
      replaced(slab, "set conductivity = 2.2", "set conductivity = 2.2*(1 - 0.004*T)"),
      "set latent heat = 333500",
      "set latent heat = 333500\n    set lowest temperature = -40\n"
      "    set highest temperature = 60");

  const std::string ranged
      = replaced(slab, "set melting temperature = 0",
                 "set solidus temperature = -2\n    set liquidus temperature = 0");

  std::string about(const std::string &text, const std::string &old_piece,
                    const std::string &new_piece)
  {
    return complaint(replaced(text, old_piece, new_piece));
  }

  bool holds(const std::string &text, const std::string &piece)
  {
    return text.find(piece) != std::string::npos;
  }
} // namespace

TEST(MaterialCase, AnExpressionOfTemperature)
{
  const Case c = read(varying);
  const Material &material = c.scene.material;
  ASSERT_TRUE(material.curves);
  EXPECT_NEAR(material.solid.conductivity_at(-10), 2.2 * 1.04, 1e-12);
  EXPECT_DOUBLE_EQ(material.solid.conductivity, 2.2);
  EXPECT_FALSE(material.liquid.conductivity_curve);
  // u = int k dT
  EXPECT_NEAR(material.curves->at_temperature(-10).kirchhoff,
              -2.2 * (10 + 0.004 * 10 * 10 / 2), 1e-10);
  const EffectSet effects = effects_called_for(c.scene);
  EXPECT_TRUE(effects.contains(Effect::variable_conductivity));
  EXPECT_FALSE(effects.contains(Effect::variable_heat_capacity));
  EXPECT_FALSE(effects.contains(Effect::melting_range));
}

TEST(MaterialCase, ATableOfTemperature)
{
  const Case c
      = read(replaced(slab, "set specific heat capacity = 2090",
                      "set specific heat capacity = -40: 1900, 0: 2090, 20: 2090"));
  EXPECT_NEAR(c.scene.material.solid.heat_capacity_at(-20), 1995, 1e-12);
  EXPECT_TRUE(effects_called_for(c.scene).contains(Effect::variable_heat_capacity));
  EXPECT_EQ(c.scene.material.known_temperatures().first, -40);
}

TEST(MaterialCase, EffectsThatAreOffLeaveConstants)
{
  Scene scene = read(varying).scene;
  scene.effect_choices[Effect::variable_conductivity] = EffectChoice::off;
  const Scene simulated = simulated_scene(scene, effects_called_for(scene));
  EXPECT_FALSE(simulated.material.curves);
  EXPECT_DOUBLE_EQ(simulated.material.solid.conductivity_at(-10), 2.2);

  scene = read(ranged).scene;
  scene.effect_choices[Effect::melting_range] = EffectChoice::off;
  const Scene sharp = simulated_scene(scene, effects_called_for(scene));
  EXPECT_FALSE(sharp.material.curves);
  EXPECT_EQ(sharp.material.melting_temperature, -1);
}

TEST(MaterialCase, AMeltingRange)
{
  const Material linear = read(ranged).scene.material;
  EXPECT_EQ(linear.melting_temperature, -2);
  EXPECT_NEAR(linear.curves->at_temperature(-0.5).solid_fraction, 0.25, 1e-12);
  EXPECT_EQ(linear.curves->jump(), 0);

  const std::string rule
      = "set liquidus temperature = 0\n    set partition coefficient = "
        "0.2\n    set solvent melting temperature = 1\n    set solid "
        "fraction = ";
  const Material scheil
      = read(replaced(ranged, "set liquidus temperature = 0", rule + "Scheil"))
            .scene.material;
  // f_s = 1 - (3/1)^(1/(0.2 - 1)) at the solidus; the rest freezes there
  const double rest = std::pow(3., -1 / 0.8);
  EXPECT_NEAR(scheil.curves->jump(), 333500 * rest, 1e-6);
  EXPECT_NEAR(scheil.curves->at_temperature(-1).solid_fraction,
              1 - std::pow(2., -1 / 0.8), 1e-6);
  const Material lever
      = read(replaced(ranged, "set liquidus temperature = 0", rule + "lever"))
            .scene.material;
  EXPECT_NEAR(lever.curves->at_temperature(-1).solid_fraction, 1 / (0.8 * 2), 1e-6);
}

TEST(MaterialCase, WhatCannotBeIsRefused)
{
  EXPECT_TRUE(holds(about(varying, "    set lowest temperature = -40\n", ""),
                    "'lowest temperature'"));
  EXPECT_TRUE(holds(about(varying, "lowest temperature = -40", "lowest temperature = -5"),
                    "is known from -5 to 60, and the scene needs it at -10"));
  EXPECT_TRUE(holds(about(varying, "0.004*T", "0.04*T"), "must be greater than 0"));
  EXPECT_TRUE(holds(about(varying, "0.004*T", "0.004*U"), "not '2.2*(1 - 0.004*U)'"));
  EXPECT_TRUE(
      holds(about(slab, "conductivity = 2.2", "conductivity = 0: 2, -5: 3"), "ascend"));
  EXPECT_TRUE(
      holds(about(slab, "conductivity = 2.2", "conductivity = 0: 2, 5"), "needs points"));
  EXPECT_TRUE(
      holds(about(ranged, "liquidus temperature = 0", "liquidus temperature = -3"),
            "must exceed the solidus"));
  EXPECT_TRUE(
      holds(about(ranged, "set solidus temperature = -2",
                  "set solidus temperature = -2\n    set melting temperature = 0"),
            "'melting temperature'"));
  EXPECT_TRUE(holds(about(ranged, "set solidus temperature = -2",
                          "set solidus temperature = -2\n    set solid fraction = 1 + T"),
                    "must lie above 0"));
  EXPECT_TRUE(holds(about(ranged, "set solidus temperature = -2",
                          "set solidus temperature = -2\n    set solid fraction = lever"),
                    "'partition coefficient'"));
  // Neumann's solution is known of these, others are not.
  EXPECT_EQ(complaint(varying + "subsection Exact solution\n  set kind = neumann\nend\n"),
            "no complaint");
  EXPECT_TRUE(holds(complaint(varying
                              + "subsection Exact solution\n  set kind = oracle\n"
                                "  set start = one phase\nend\n"),
                    "do not depend on temperature"));
}
