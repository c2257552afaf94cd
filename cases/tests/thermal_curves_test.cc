#include <cases/error.h>
#include <cases/material.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace meltfront::cases;

namespace
{
  std::shared_ptr<const PropertyCurve> line(double at_minus_one, double at_one)
  {
    return std::make_shared<PropertyCurve>(
        std::vector<double>{-1, 1}, std::vector<double>{at_minus_one, at_one}, "line");
  }

  /** Conductivities 1 - T/2 and (1 + T/2)/2, heat capacities 2 - T and 3, melting at 0.
   */
  Material varying()
  {
    Material material;
    material.latent_heat = 5;
    material.solid.conductivity_curve = line(1.5, 0.5);
    material.solid.heat_capacity_curve = line(3, 1);
    material.liquid = {0.5, 3, 1};
    material.liquid.conductivity_curve = line(0.25, 0.75);
    material.update_curves();
    return material;
  }

  /** As varying(), partly solid between 0 and 0.4, of which a fifth freezes at 0. */
  Material with_range()
  {
    Material material = varying();
    MeltingRange range{0, 0.4, {}, "table"};
    range.solid_fraction = std::make_shared<PropertyCurve>(
        std::vector<double>{0, 0.1, 0.4}, std::vector<double>{0.8, 0.3, 0}, "table");
    material.melting_range = std::make_shared<MeltingRange>(range);
    material.update_curves();
    return material;
  }
} // namespace

TEST(ThermalCurves, IntegralsOfStraightLines)
{
  const Material material = varying();
  const ThermalCurves &curves = *material.curves;
  for(const double t : {-1., -0.7, -0.2, -1e-9})
  {
    const ThermalState state = curves.at_temperature(t);
    EXPECT_NEAR(state.kirchhoff, t - t * t / 4, 1e-15);
    EXPECT_NEAR(state.enthalpy, 2 * t - t * t / 2, 1e-15);
    EXPECT_NEAR(state.conductivity, 1 - t / 2, 1e-15);
    EXPECT_NEAR(state.capacity, 2 - t, 1e-15);
    EXPECT_EQ(state.solid_fraction, 1);
  }
  for(const double t : {1e-9, 0.3, 1.})
  {
    const ThermalState state = curves.at_temperature(t);
    EXPECT_NEAR(state.kirchhoff, t / 2 + t * t / 8, 1e-15);
    EXPECT_NEAR(state.enthalpy, 5 + 3 * t, 1e-14);
    EXPECT_EQ(state.solid_fraction, 0);
  }
  EXPECT_EQ(curves.at_temperature(0).enthalpy, 5);
  EXPECT_EQ(curves.jump(), 5);
  // Beyond the last points of the curves they keep their values.
  EXPECT_NEAR(curves.at_temperature(3).kirchhoff, 0.625 + 2 * 0.75, 1e-15);
  EXPECT_NEAR(curves.at_temperature(-2).enthalpy, -2.5 - 3, 1e-15);
}

TEST(ThermalCurves, TheJumpIsAtTheMeltingTemperature)
{
  const Material material = varying();
  for(const double enthalpy : {0., 1., 4.9, 5.})
  {
    const ThermalState state = material.curves->at_enthalpy(enthalpy);
    EXPECT_EQ(state.temperature, 0);
    EXPECT_EQ(state.kirchhoff, 0);
    EXPECT_NEAR(state.solid_fraction, 1 - enthalpy / 5, 1e-15);
    EXPECT_EQ(material.temperature(enthalpy), 0);
    EXPECT_NEAR(material.solid_fraction(enthalpy), 1 - enthalpy / 5, 1e-15);
  }
  EXPECT_EQ(material.enthalpy(0, 0.25), 0.75 * 5);
}

TEST(ThermalCurves, EachVariableTellsTheOthers)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> temperatures(-3, 3);
  for(const Material &material : {varying(), with_range()})
    for(int i = 0; i < 1000; ++i)
    {
      const ThermalCurves &curves = *material.curves;
      const ThermalState state = curves.at_temperature(temperatures(random));
      for(const ThermalState &same :
          {curves.at_enthalpy(state.enthalpy), curves.at_kirchhoff(state.kirchhoff),
           curves.resolve(2 * state.enthalpy + 3 * state.kirchhoff + state.temperature, 2,
                          3, 1)})
      {
        EXPECT_NEAR(same.temperature, state.temperature, 1e-13);
        EXPECT_NEAR(same.enthalpy, state.enthalpy, 1e-12);
        EXPECT_NEAR(same.kirchhoff, state.kirchhoff, 1e-13);
        EXPECT_NEAR(same.solid_fraction, state.solid_fraction, 1e-12);
      }
    }
}

TEST(ThermalCurves, TablesThatReachFarLoseNoDigits)
{
  Material material = varying();
  const auto far = [](double value)
  {
    return std::make_shared<PropertyCurve>(std::vector<double>{-1e7, -2, 3, 1e7},
                                           std::vector<double>{1, value, value, 1},
                                           "table");
  };
  material.solid.conductivity_curve = material.liquid.conductivity_curve = far(2);
  material.solid.heat_capacity_curve = material.liquid.heat_capacity_curve = far(3);
  material.update_curves();
  for(const double t : {-4., -2.5, -1., 1., 3.5, 5.})
  {
    const ThermalState state = material.curves->at_temperature(t);
    EXPECT_NEAR(material.curves->at_kirchhoff(state.kirchhoff).temperature, t, 1e-14);
    EXPECT_NEAR(state.kirchhoff, 2 * t, 1e-5);
    EXPECT_NEAR(material.curves->at_enthalpy(state.enthalpy).kirchhoff, state.kirchhoff,
                1e-14);
  }
}

TEST(ThermalCurves, AMeltingRangeReleasesAllOfTheLatentHeat)
{
  const Material material = with_range();
  const ThermalCurves &curves = *material.curves;
  EXPECT_NEAR(curves.jump(), 1, 1e-15);
  EXPECT_NEAR(curves.at_enthalpy(0.5).solid_fraction, 0.9, 1e-15);
  EXPECT_NEAR(curves.at_temperature(0.05).solid_fraction, 0.55, 1e-12);
  EXPECT_NEAR(curves.at_temperature(0.4).solid_fraction, 0, 1e-15);
  // c = f (2 - T) + (1 - f) 3, piecewise quadratic: Simpson's rule is exact for its
  // integral
  const auto capacity = [](double t)
  {
    const double solid = t < 0.1 ? 0.8 - 5 * t : 0.4 - t;
    return solid * (2 - t) + (1 - solid) * 3;
  };
  const double sensible
      = 0.1 / 6 * (capacity(0) + 4 * capacity(0.05) + capacity(0.1))
        + 0.3 / 6 * (capacity(0.1) + 4 * capacity(0.25) + capacity(0.4));
  EXPECT_NEAR(curves.at_temperature(0.4).enthalpy, 5 + sensible, 1e-5);
  for(const double t : {0.02, 0.2, 0.39})
  {
    const double step = 1e-6;
    EXPECT_NEAR((curves.at_temperature(t + step).enthalpy
                 - curves.at_temperature(t - step).enthalpy)
                    / (2 * step),
                curves.at_temperature(t).capacity, 1e-3);
  }
}

TEST(ThermalCurves, LeastSlopeLimitsSteps)
{
  const Material material = varying();
  // (2 - T)/(1 - T/2) = 2 in the solid; 3/(0.5 + T/4) falls to 4 at T = 1
  EXPECT_NEAR(material.curves->least_slope(-1, -0.5), 2, 1e-14);
  EXPECT_NEAR(material.curves->least_slope(0.5, 1), 4, 1e-14);
}

TEST(ThermalCurves, RefusesWhatIsNoMaterial)
{
  Material material = varying();
  material.solid.conductivity_curve = line(1, -1);
  EXPECT_THROW(material.update_curves(), InputError);
  MeltingRange range{0, 0.4, {}, "table"};
  range.solid_fraction = std::make_shared<PropertyCurve>(
      std::vector<double>{0, 0.1, 0.4}, std::vector<double>{0.8, 0.9, 0}, "table");
  material = varying();
  material.melting_range = std::make_shared<MeltingRange>(range);
  EXPECT_THROW(material.update_curves(), InputError);
  EXPECT_THROW(PropertyCurve({1, 1}, {2, 2}, "table"), InputError);
}
