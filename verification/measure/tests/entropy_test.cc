#include <cases/alloy.h>
#include <cases/error.h>
#include <verification/measure/formulas/entropy.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront;
using namespace meltfront::verification;

namespace
{
  constexpr double absolute_zero = -273.15;

  /** Salt water of density 2 in a slab. */
  cases::Scene salt_water()
  {
    cases::Scene scene
        = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
    scene.material = {{2.4, 2006, 2}, {0.5, 4180, 2}, 334400, 0};
    scene.alloy.emplace();
    scene.alloy->solutes.push_back({.name = "salt", .liquidus_slope = 42.28});
    return scene;
  }

  /** One site of unit volume that holds an enthalpy and solute in equilibrium. */
  tests::State site(const cases::Scene &scene, double enthalpy, double concentration)
  {
    const cases::PhaseDiagram diagram(scene.material, *scene.alloy);
    const cases::PhaseState phases = diagram.equilibrium(enthalpy, concentration);
    tests::State state;
    state.positions[0] = {0.5};
    state.weights = {1};
    state.temperature = {phases.temperature};
    state.solid_fraction = {1 - phases.liquid_fraction};
    state.concentration[0] = {concentration};
    return state;
  }

  double total(const cases::Scene &scene, double enthalpy, double concentration)
  {
    return EntropyMeter(scene, absolute_zero)
        .of(site(scene, enthalpy, concentration).view(1, 0))
        .total;
  }
} // namespace

TEST(Entropy, ItsDerivativeByTheEnthalpyIsTheInverseTemperature)
{
  const cases::Scene scene = salt_water();
  const double mass = scene.material.liquid.density;
  for(const double concentration : {0.02, 0.14})
    for(double enthalpy = -20000; enthalpy < 400000; enthalpy += 9001)
    {
      constexpr double step = 20;
      const double slope = (total(scene, enthalpy + step, concentration)
                            - total(scene, enthalpy - step, concentration))
                           / (2 * step * mass);
      const double temperature
          = site(scene, enthalpy, concentration).temperature[0] - absolute_zero;
      EXPECT_NEAR(slope * temperature, 1, 1e-6) << enthalpy;
    }
}

TEST(Entropy, IsConcaveInEnthalpyAndConcentrationTogether)
{
  const cases::Scene scene = salt_water();
  for(double enthalpy = -10000; enthalpy < 400000; enthalpy += 17003)
    for(const double away : {-20000., 0., 20000.})
      for(const double less : {0., 0.01, 0.04})
      {
        const double middle = total(scene, enthalpy, 0.1);
        const double ends = total(scene, enthalpy + away, 0.1 + less)
                            + total(scene, enthalpy - away, 0.1 - less);
        EXPECT_LE(ends / 2, middle + 1e-12 * std::abs(middle)) << enthalpy;
      }
}

TEST(Entropy, OfIdealMixingByHand)
{
  cases::Scene scene = salt_water();
  tests::State state = site(scene, 400000, 0.25);
  const double expected
      = -2 * (0.25 * std::log(0.25) + 0.75 * std::log(0.75)); // density 2
  EXPECT_NEAR(EntropyMeter(scene, absolute_zero).of(state.view(1, 0)).mixing, expected,
              1e-14);
  scene.alloy.reset();
  EXPECT_TRUE(std::isnan(EntropyMeter(scene, absolute_zero).of(state.view(1, 0)).mixing));
}

TEST(Entropy, OfAPureSubstanceByHand)
{
  cases::Scene scene = salt_water();
  scene.alloy.reset();
  tests::State state;
  state.positions[0] = {0.25, 0.75};
  state.weights = {0.5, 0.5};
  state.temperature = {-10, 20};
  state.solid_fraction = {1, 0};
  const double cold = 2006 * std::log(263.15 / 273.15);
  const double warm = 4180 * std::log(293.15 / 273.15) + 334400 / 273.15;
  EXPECT_NEAR(EntropyMeter(scene, absolute_zero).of(state.view(1, 0)).total, cold + warm,
              1e-9);
}

TEST(Entropy, AbsoluteZeroAboveTheMeltingPointIsRefused)
{
  EXPECT_THROW(EntropyMeter(salt_water(), 1), cases::InputError);
}

TEST(Entropy, OfTwoSolutesIsNotClaimed)
{
  cases::Scene scene = salt_water();
  scene.alloy->solutes.push_back({.name = "sugar", .liquidus_slope = 2});
  tests::State state = site(scene, 400000, 0.25);
  state.concentration[1] = {0.1};
  const Entropy entropy = EntropyMeter(scene, absolute_zero).of(state.view(1, 0));
  EXPECT_TRUE(std::isnan(entropy.total));
  EXPECT_NEAR(entropy.mixing,
              -2 * (0.25 * std::log(0.25) + 0.1 * std::log(0.1) + 0.65 * std::log(0.65)),
              1e-14);
}
