#include <cases/case_file/tests/sample_case.h>
#include <cases/effects.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  const std::string liquid_of_slab
      = "    subsection Liquid\n      set conductivity = 0.591\n    end\n";

  /** The slab as an alloy: subsections of the material and lines of the initial state. */
  std::string alloy(const std::string &subsections, const std::string &initial)
  {
    const std::string text = replaced(slab, liquid_of_slab, liquid_of_slab + subsections);
    return replaced(text, "set temperature = 10\n", "set temperature = 10\n" + initial);
  }

  std::string solute(int number, const std::string &liquidus,
                     const std::string &more = {})
  {
    return fmt::format("    subsection Solute {}\n      set name = salt\n      set "
                       "liquidus = {}\n{}    end\n",
                       number, liquidus, more);
  }

  std::string properties(const std::string &lines)
  {
    return fmt::format("    subsection Alloy\n{}    end\n", lines);
  }

  const std::string eighth = "    set concentration = 0.125\n";

  /** A complaint without `a.prm:LINE: `. */
  std::string about(const std::string &text)
  {
    const std::string message = complaint(text);
    return message.substr(message.find(' ') + 1);
  }

  std::string about_liquidus(const std::string &liquidus, const std::string &more = {})
  {
    const std::string message = about(alloy(solute(1, liquidus, more), eighth));
    const std::string key = "key 'liquidus' in subsection 'Scene/Material/Solute 1' ";
    return message.starts_with(key) ? message.substr(key.size()) : message;
  }
} // namespace

TEST(AlloyCase, AStraightLiquidus)
{
  const Case c = read(alloy(
      solute(1, "84.56/2", "      set diffusivity = 6.2e-10\n")
          + properties("      set crystal density = 917\n      set eutectic temperature "
                       "= -17.5\n"),
      "    set concentration = 0.1 + x\n"));
  ASSERT_TRUE(c.scene.alloy.has_value());
  const Alloy &found = *c.scene.alloy;
  ASSERT_EQ(found.solutes.size(), 1u);
  EXPECT_EQ(found.solutes[0].name, "salt");
  EXPECT_EQ(found.solutes[0].liquidus_slope, 42.28);
  EXPECT_EQ(found.solutes[0].diffusivity, 6.2e-10);
  EXPECT_EQ(found.solutes[0].liquidus, "84.56/2");
  EXPECT_FALSE(found.solutes[0].liquidus_curve);
  EXPECT_EQ(found.crystal_density, 917);
  EXPECT_EQ(found.eutectic_temperature, -17.5);
  ASSERT_EQ(c.scene.initial.concentration.size(), 1u);
  EXPECT_EQ(c.scene.initial.concentration[0]({0.05, 0, 0}, 0), 0.1 + 0.05);
  const EffectSet effects = effects_called_for(c.scene);
  EXPECT_TRUE(effects.contains(Effect::solute));
  EXPECT_TRUE(effects.contains(Effect::solute_diffusion));
  EXPECT_FALSE(effects.contains(Effect::eutectic));
  EXPECT_FALSE(read(slab).scene.alloy.has_value());
}

TEST(AlloyCase, ALiquidusByFormulaAndByTable)
{
  const std::string largest = "      set largest concentration = 0.4\n";
  const Case formula = read(alloy(solute(1, "-50*C - 80*C^2", largest), eighth));
  const auto &curve = formula.scene.alloy->solutes[0].liquidus_curve;
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve(0), 0);
  EXPECT_NEAR(curve(0.2), 13.2, 1e-13);
  EXPECT_EQ(curve(0.7), curve(0.4)) << "known up to 0.4 only";
  EXPECT_EQ(formula.scene.alloy->solutes[0].largest_concentration, 0.4);
  const Case table
      = read(alloy(solute(1, "0: 0, 0.1: -4, 0.2: -9, 0.3: -15, 0.4: -22"), eighth));
  const Solute &solute = table.scene.alloy->solutes[0];
  EXPECT_EQ(solute.largest_concentration, 0.4);
  EXPECT_NEAR(solute.liquidus_curve(0.2), 9, 1e-13);
  EXPECT_GT(solute.liquidus_curve(0.15), 4);
  EXPECT_LT(solute.liquidus_curve(0.15), 9);
  EXPECT_NEAR(PhaseDiagram(table.scene.material, *table.scene.alloy).liquidus(0.3), -15,
              1e-13);
}

TEST(AlloyCase, TwoSolutes)
{
  const Case c = read(alloy(solute(1, "20") + solute(2, "30"),
                            eighth + "    set second concentration = 0.25\n"));
  ASSERT_EQ(c.scene.initial.concentration.size(), 2u);
  EXPECT_EQ(PhaseDiagram(c.scene.material, *c.scene.alloy).liquidus(0.125, 0.25), -10);
  EXPECT_EQ(about(alloy(solute(1, "20") + solute(2, "-30*C"),
                        eighth + "    set second concentration = 0.25\n")),
            "key 'liquidus' in subsection 'Scene/Material/Solute 2' is curved, which "
            "needs the solute to be the only one: with two solutes both must be slopes");
  EXPECT_EQ(about(alloy(solute(1, "20") + solute(2, "30"), eighth)),
            "key 'second concentration' in subsection 'Scene/Initial state' is missing: "
            "there is salt in the liquid");
  EXPECT_EQ(about(alloy(solute(1, "20") + solute(2, "30"),
                        eighth + "    set second concentration = 0.875\n")),
            "key 'second concentration' in subsection 'Scene/Initial state' makes 1 at x "
            "= 0.003 together with the first; mass fractions must sum to less than 1");
}

TEST(AlloyCase, SolutesThatCannotBe)
{
  const auto of = [](const std::string &key)
  { return fmt::format("key '{}' in subsection 'Scene/Material/Solute 1' ", key); };
  EXPECT_EQ(
      about(alloy("    subsection Solute 1\n      set name = salt\n    end\n", eighth)),
      of("liquidus")
          + "is missing: a solute lowers the melting "
            "temperature");
  EXPECT_EQ(
      about(alloy("    subsection Solute 1\n      set liquidus = 40\n    end\n", eighth)),
      of("name") + "is missing: a solute needs one");
  EXPECT_EQ(about(alloy(solute(1, "40", "      set diffusivity = -1\n"), eighth)),
            of("diffusivity") + "needs a number of at least 0 (m^2/s), not '-1'");
  EXPECT_EQ(
      about(alloy(solute(1, "40", "      set largest concentration = 0.3\n"), eighth)),
      of("largest concentration")
          + "has no meaning here: the liquidus is no expression of C");
  EXPECT_EQ(about(alloy(solute(2, "40"), "")),
            "subsection 'Scene/Material/Solute 2' has no meaning here: there is no "
            "subsection 'Scene/Material/Solute 1'");
  EXPECT_EQ(about(alloy(properties("      set crystal density = 917\n"), "")),
            "subsection 'Scene/Material/Alloy' has no meaning here: there is no "
            "subsection 'Scene/Material/Solute 1'");
  EXPECT_EQ(about(alloy("", eighth)),
            "key 'concentration' in subsection 'Scene/Initial state' has no meaning "
            "here: there is no subsection 'Scene/Material/Solute 1'");
}

TEST(AlloyCase, LiquidiThatCannotBe)
{
  EXPECT_EQ(about_liquidus("-40"), "is the slope -40; a slope must be greater than 0, by "
                                   "which the liquidus falls per unit mass fraction");
  EXPECT_EQ(about_liquidus("40*x"), "depends on x, which it may not here");
  EXPECT_EQ(about_liquidus("-40*C + x"), "depends on x, which it may not here");
  EXPECT_EQ(about_liquidus("40*C"),
            "must fall as C rises: it is 0.15625 at C = 0.00390625 after 0 (the key "
            "'largest concentration' says where it ends)");
  EXPECT_EQ(about_liquidus("1 - 40*C"),
            "is 1 at C = 0, where it must be the melting temperature 0");
  EXPECT_EQ(about_liquidus("-40*C - 1e-3/C"),
            "is -inf at C = 0, where it must be the melting temperature 0");
  EXPECT_EQ(about_liquidus("-40*C/(0.5 - C)"),
            "must fall as C rises: it is -inf at C = 0.5 after -5080 (the key 'largest "
            "concentration' says where it ends)");
  EXPECT_EQ(about_liquidus("0: 0, 0.1"),
            "needs points 'mass fraction: temperature' separated by commas, not '0.1'");
  EXPECT_EQ(about_liquidus("0: 0, 0.1: cold"), "holds 'cold', which is no number");
  EXPECT_EQ(about_liquidus("0: 0, 0.1: -4, 0.2: -8"),
            "is no liquidus: a liquidus needs at least four points, not 3");
  EXPECT_EQ(about_liquidus("0: 0, 0.1: -4, 0.2: -3, 0.3: -9"),
            "is no liquidus: a liquidus falls as the concentration rises; point 3 does "
            "not");
  EXPECT_EQ(about_liquidus("0: 0, 0.5: -4, 1: -8, 1.5: -12"),
            "goes on to the mass fraction 1.5; 1 is all");
  EXPECT_EQ(about_liquidus("0: 0, 0.1: -1, 0.2: -2, 0.3: -3"),
            "the liquidus is not known down to the temperature -10");
  EXPECT_EQ(about_liquidus("9"),
            "makes the solute of the liquid exceed the liquid's own mass at -10, to "
            "which the scene may cool: state a eutectic temperature above that");
}

TEST(AlloyCase, ConcentrationsThatCannotBe)
{
  const auto about_start
      = [](const std::string &initial, const std::string &subsections = {})
  { return about(alloy(solute(1, "40") + subsections, initial)); };
  const std::string key = "key 'concentration' in subsection 'Scene/Initial state' ";
  EXPECT_EQ(about_start(""), key + "is missing: there is salt in the liquid");
  EXPECT_EQ(about_start("    set concentration = 1\n"),
            key + "is 1 at x = 0.003; a mass fraction is at least 0 and less than 1");
  EXPECT_EQ(about_start("    set concentration = 0.01 - x\n"),
            key
                + "is -0.0165 at x = 0.0265; a mass fraction is at least 0 and less "
                  "than 1");
  EXPECT_EQ(about_start("    set concentration = ln(x - x)\n"),
            key + "is -inf at x = 0.003, t = 0");
  EXPECT_EQ(about_start("    set concentration = t\n"),
            key + "depends on t, which it may not here");
  EXPECT_EQ(about_start("    set concentration = 0.5\n",
                        properties("      set eutectic temperature = -18\n")),
            key
                + "puts the liquidus to -20 at x = 0.003, not above the eutectic "
                  "temperature -18: crystals of solute, not of solvent, would grow");
  EXPECT_EQ(about_start(eighth + "    set second concentration = 0.1\n"),
            "key 'second concentration' in subsection 'Scene/Initial state' has no "
            "meaning here: the material has one solute");
  EXPECT_EQ(about_start(eighth + "    set front = x - 0.1\n"),
            "key 'front' in subsection 'Scene/Initial state' has no meaning here: the "
            "liquidus of an alloy says what is solid");
}

TEST(AlloyCase, MaterialsEffectsAndMeasuresThatCannotBe)
{
  const std::string salty = alloy(solute(1, "40"), eighth);
  EXPECT_EQ(complaint(salty), "no complaint");
  EXPECT_EQ(about(replaced(salty, "latent heat = 333500", "latent heat = 0")),
            "key 'latent heat' in subsection 'Scene/Material' must be greater than 0 in "
            "an alloy");
  EXPECT_TRUE(about(replaced(salty, "set conductivity = 0.591",
                             "set conductivity = 0.591\n      set density = 917"))
                  .starts_with("key 'density' in subsection 'Scene/Material/Liquid' must "
                               "be that of the solid in an alloy"));
  EXPECT_EQ(
      about(alloy(solute(1, "40") + properties("      set eutectic temperature = 0\n"),
                  eighth)),
      "key 'eutectic temperature' in subsection 'Scene/Material/Alloy' (0) must "
      "lie below the melting temperature of the solvent (0)");
  EXPECT_EQ(about(salty + "subsection Exact solution\n  set kind = neumann\nend\n"),
            "key 'kind' in subsection 'Exact solution' cannot be 'neumann' for an alloy; "
            "what is known of one is 'mushy layer'");
  const auto on = [](const std::string &effect)
  { return fmt::format("subsection Effects\n  set {} = on\nend\n", effect); };
  EXPECT_EQ(about(slab + on("solute")),
            "key 'solute' in subsection 'Effects' is on but there is no subsection "
            "'Scene/Material/Solute 1'");
  EXPECT_EQ(about(salty + on("solute_diffusion")),
            "key 'solute_diffusion' in subsection 'Effects' is on but key 'diffusivity' "
            "in subsection 'Scene/Material/Solute 1' is missing");
  EXPECT_EQ(about(salty + on("eutectic")),
            "key 'eutectic' in subsection 'Effects' is on but key 'eutectic temperature' "
            "in subsection 'Scene/Material/Alloy' is missing");
  EXPECT_EQ(complaint(salty + on("solute")), "no complaint");
  const auto zero = [](const std::string &value)
  { return fmt::format("subsection Measure\n  set absolute zero = {}\nend\n", value); };
  EXPECT_EQ(read(salty + zero("-273.15")).measurement.absolute_zero, -273.15);
  EXPECT_FALSE(read(salty).measurement.absolute_zero.has_value());
  EXPECT_EQ(about(salty + zero("-10")),
            "key 'absolute zero' in subsection 'Measure' (-10) must lie below every "
            "temperature of the scene, which may fall to -10");
}

namespace
{
  const std::string layer = "subsection Exact solution\n  set kind = mushy layer\n";

  std::string with_exact_wall(const std::string &text)
  {
    return replaced(text, "set kind = insulated", "set kind = exact");
  }
} // namespace

TEST(AlloyCase, AMushyLayerIsTheExactSolution)
{
  const Case c = read(with_exact_wall(alloy(solute(1, "40"), eighth)) + layer + "end\n");
  ASSERT_TRUE(c.exact && c.exact->mushy());
  EXPECT_NEAR(c.exact->temperature(c.exact->front(50), 50), -5, 1e-12);
  EXPECT_EQ(c.exact->concentration(0.01, 50), 0.125);
  EXPECT_EQ(c.scene.boundary(Side::x_max).value({0.1, 0, 0}, 50),
            c.exact->temperature(0.1, 50));
}

TEST(AlloyCase, AnExactStateHoldsItsConcentrations)
{
  std::string text = alloy(solute(1, "20") + solute(2, "30"), "");
  text = replaced(text, "set temperature = 10\n", "set kind = exact\n");
  text
      = replaced(text, "set end time = 100", "set start time = 10\n  set end time = 100");
  const std::string far = "  set far temperature = 10\n  set far concentration = 0.1\n";
  const Case c = read(with_exact_wall(text) + layer + far
                      + "  set far second concentration = 0.1\nend\n");
  ASSERT_EQ(c.scene.initial.concentration.size(), 2u);
  EXPECT_EQ(c.scene.initial.concentration[1]({0.001, 0, 0}, 10), 0.1);
  EXPECT_FALSE(c.scene.initial.front.has_value()) << "a mush has no sharp front";
  EXPECT_TRUE(effects_called_for(c.scene).contains(Effect::solute));
  EXPECT_NEAR(c.exact->temperature(c.exact->front(50), 50), -5, 1e-12);
  EXPECT_EQ(about(with_exact_wall(text) + layer + far + "end\n"),
            "key 'far second concentration' in subsection 'Exact solution' is missing: "
            "the mushy layer freezes from a melt");
}

TEST(AlloyCase, MushyLayersThatCannotBe)
{
  const std::string salty = with_exact_wall(alloy(solute(1, "40"), eighth));
  const auto about_layer = [&salty](const std::string &keys)
  { return about(salty + layer + keys + "end\n"); };
  const auto of = [](const std::string &key)
  { return fmt::format("key '{}' in subsection 'Exact solution' ", key); };
  EXPECT_EQ(about_layer("  set far concentration = 0.1\n"),
            of("far concentration") + "has no meaning here: the initial state says it");
  EXPECT_EQ(
      about_layer("  set far temperature = -6\n"),
      of("kind")
          + "gives no solution: mushy layer: the far temperature (-6) must be above "
            "the liquidus (-5)");
  EXPECT_EQ(about(with_exact_wall(slab) + layer + "end\n"),
            of("kind")
                + "cannot be 'mushy layer' for a pure substance: there is no subsection "
                  "'Scene/Material/Solute 1'");
  EXPECT_EQ(
      about(with_exact_wall(alloy(solute(1, "40"), "    set concentration = 0.1 + x\n"))
            + layer + "end\n"),
      "key 'concentration' in subsection 'Scene/Initial state' must be the same "
      "everywhere for a mushy layer to be the exact solution");
  EXPECT_EQ(about(slab
                  + "subsection Exact solution\n  set far concentration = "
                    "0.1\nend\n"),
            of("far concentration")
                + "has no meaning here: it is a key of the mushy layer");
}
