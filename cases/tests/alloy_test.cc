#include <cases/alloy.h>
#include <cases/error.h>

#include <gtest/gtest.h>

using namespace meltfront::cases;

namespace
{
  /** Water with a salt whose liquidus falls by 42.28 K per unit mass fraction. */
  Material solvent()
  {
    Material material;
    material.solid = {2.408, 2006, 1097};
    material.liquid = {0.498, 4180, 1097};
    material.latent_heat = 334400;
    material.melting_temperature = 3; // not zero: it must not drop out unnoticed
    return material;
  }

  Alloy salt(double eutectic_excess = -1e300)
  {
    Alloy alloy;
    alloy.solutes.push_back({"salt", 42.28});
    alloy.eutectic_temperature = 3 + eutectic_excess;
    alloy.crystal_density = 917;
    return alloy;
  }

  /** Temperature and liquid fraction put into the definition of the enthalpy. */
  double enthalpy_of(const PhaseState &state)
  {
    const Material m = solvent();
    const double excess = state.temperature - m.melting_temperature;
    return (1 - state.liquid_fraction) * 2006 * excess
           + state.liquid_fraction * (4180 * excess + m.latent_heat);
  }
} // namespace

TEST(PhaseDiagram, EquilibriumHoldsTheEnthalpyAndTheLeverRule)
{
  const PhaseDiagram diagram(solvent(), salt());
  for(const double concentration : {0.01, 0.14, 0.3})
    for(double enthalpy = -60000; enthalpy < 450000; enthalpy += 777)
    {
      const PhaseState state = diagram.equilibrium(enthalpy, concentration);
      EXPECT_NEAR(enthalpy_of(state), enthalpy, 1e-9);
      if(state.liquid_fraction < 1)
        EXPECT_NEAR(diagram.liquidus(concentration / state.liquid_fraction),
                    state.temperature, 1e-11)
            << enthalpy;
      else
        EXPECT_GE(state.temperature, diagram.liquidus(concentration) - 1e-12);
      EXPECT_NEAR(diagram.enthalpy(state.temperature, concentration), enthalpy, 1e-8);
      EXPECT_NEAR(diagram.solid_fraction(state.temperature, concentration),
                  1 - state.liquid_fraction, 1e-13);
    }
}

TEST(PhaseDiagram, WithoutSoluteItIsThePureSubstance)
{
  const Material material = solvent();
  const PhaseDiagram diagram(material, salt());
  for(double enthalpy = -60000; enthalpy < 450000; enthalpy += 777)
  {
    const PhaseState state = diagram.equilibrium(enthalpy, 0);
    EXPECT_NEAR(state.temperature, material.temperature(enthalpy), 1e-14);
    EXPECT_NEAR(1 - state.liquid_fraction, material.solid_fraction(enthalpy), 1e-15);
  }
}

TEST(PhaseDiagram, TheRestFreezesAtTheEutecticTemperature)
{
  const PhaseDiagram diagram(solvent(), salt(-18));
  const double liquid_left = 42.28 * 0.14 / 18;
  const double all_solid = 2006 * -18.;
  const double eutectic_begins
      = all_solid + liquid_left * (334400 + (4180 - 2006) * -18.);
  for(const double share : {0.1, 0.5, 0.9})
  {
    const PhaseState state
        = diagram.equilibrium(all_solid + share * (eutectic_begins - all_solid), 0.14);
    EXPECT_NEAR(state.temperature, -15, 1e-12);
    EXPECT_NEAR(state.liquid_fraction, share * liquid_left, 1e-14);
  }
  const PhaseState cold = diagram.equilibrium(all_solid - 2006, 0.14);
  EXPECT_NEAR(cold.temperature, -16, 1e-12);
  EXPECT_NEAR(cold.liquid_fraction, 0, 1e-15);
  EXPECT_GT(diagram.equilibrium(eutectic_begins + 100, 0.14).temperature, -15);
  EXPECT_EQ(diagram.solid_fraction(-15.5, 0.14), 1);
}

TEST(PhaseDiagram, TwoSolutesActByTheSumOfTheirDepressions)
{
  Alloy two = salt();
  two.solutes.push_back({"sugar", 10});
  const PhaseDiagram ternary(solvent(), two), binary(solvent(), salt());
  const double alone = 0.1 + 10 * 0.05 / 42.28;
  for(double enthalpy = -60000; enthalpy < 450000; enthalpy += 7770)
  {
    const PhaseState three = ternary.equilibrium(enthalpy, 0.1, 0.05);
    const PhaseState one = binary.equilibrium(enthalpy, alone);
    EXPECT_NEAR(three.temperature, one.temperature, 1e-12);
    EXPECT_NEAR(three.liquid_fraction, one.liquid_fraction, 1e-14);
  }
}

TEST(PhaseDiagram, ACurveThatIsStraightIsTheStraightLiquidus)
{
  Alloy curved = salt();
  curved.solutes[0].liquidus_curve = [](double c) { return 42.28 * c; };
  const PhaseDiagram diagram(solvent(), curved), straight(solvent(), salt());
  for(double enthalpy = -20000; enthalpy < 450000; enthalpy += 777)
  {
    const PhaseState found = diagram.equilibrium(enthalpy, 0.14);
    const PhaseState expected = straight.equilibrium(enthalpy, 0.14);
    EXPECT_NEAR(found.temperature, expected.temperature, 1e-10);
    EXPECT_NEAR(found.liquid_fraction, expected.liquid_fraction, 1e-13);
    EXPECT_NEAR(diagram.solid_fraction(found.temperature, 0.14),
                1 - found.liquid_fraction, 1e-12);
  }
}

TEST(PhaseDiagram, CurvedLiquidusHoldsTheLeverRule)
{
  Alloy curved = salt();
  curved.solutes[0].liquidus_curve
      = liquidus_through({{0, 3}, {0.1, -1}, {0.2, -6}, {0.3, -12}, {0.4, -19}}, 3);
  curved.solutes[0].largest_concentration = 0.4;
  const PhaseDiagram diagram(solvent(), curved);
  EXPECT_NEAR(diagram.liquidus(0.3), -12, 1e-13);
  const PhaseState state = diagram.equilibrium(200000, 0.1);
  EXPECT_NEAR(enthalpy_of(state), 200000, 1e-8);
  EXPECT_NEAR(diagram.liquidus(0.1 / state.liquid_fraction), state.temperature, 1e-11);
  EXPECT_THROW(diagram.equilibrium(-60000, 0.1), InputError);
}

TEST(PhaseDiagram, ConductivityMixesByVolume)
{
  const PhaseDiagram diagram(solvent(), salt());
  EXPECT_NEAR(diagram.conductivity(0.5), 0.498 + 0.5 * 1097 / 917. * (2.408 - 0.498),
              1e-14);
  EXPECT_NEAR(diagram.conductivity(1), 2.408, 1e-14); // no more solid than space
}

TEST(PhaseDiagram, NonsenseIsRefused)
{
  Alloy two = salt();
  two.solutes[0].liquidus_curve = [](double c) { return c; };
  two.solutes.push_back({"sugar", 10});
  EXPECT_THROW(PhaseDiagram(solvent(), two), InputError);
  Alloy rising = salt();
  rising.solutes[0].liquidus_slope = -1;
  EXPECT_THROW(PhaseDiagram(solvent(), rising), InputError);
  EXPECT_THROW(liquidus_through({{0, 3}, {0.1, 2}, {0.2, 1}}, 3), InputError);
  EXPECT_THROW(liquidus_through({{0, 3}, {0.1, 2}, {0.2, 2.5}, {0.3, 1}}, 3), InputError);
  EXPECT_THROW(liquidus_through({{0, 2}, {0.1, 1}, {0.2, 0.5}, {0.3, 0}}, 3), InputError);
}
