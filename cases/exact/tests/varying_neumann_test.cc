#include <cases/error.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/tests/materials.h>
#include <cases/exact/varying_neumann.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    using Property = VaryingMaterial::Property;

    Property constant(double value)
    {
      return [value](double) { return value; };
    }

    Property linear(double at_zero, double slope)
    {
      return [=](double temperature) { return at_zero * (1 + slope * temperature); };
    }

    /** Conductivities and capacities of both phases, melting at 0. */
    VaryingMaterial sharp(const Property &solid_conductivity,
                          const Property &liquid_conductivity, double solid_capacity,
                          double liquid_capacity, double latent_heat)
    {
      VaryingMaterial material;
      material.solid_conductivity = solid_conductivity;
      material.liquid_conductivity = liquid_conductivity;
      material.solid_capacity = constant(solid_capacity);
      material.liquid_capacity = constant(liquid_capacity);
      material.latent_heat = latent_heat;
      return material;
    }

    VaryingMaterial unit()
    {
      return sharp(constant(1), constant(1), 1, 1, 1);
    }

    /** All properties one; solid fraction from `at_solidus` at -0.1 to 0 at 0.1. */
    VaryingMaterial unit_range(double at_solidus)
    {
      VaryingMaterial material = unit();
      material.melting_temperature = -0.1;
      material.liquidus = 0.1;
      material.solid_fraction
          = [=](double temperature) { return at_solidus * (0.1 - temperature) / 0.2; };
      return material;
    }

    /** Front, fluxes and temperatures at shares of the front and beyond it. */
    void expect_solution(const VaryingNeumann &solution,
                         const std::array<double, 3> &front_and_fluxes,
                         const std::array<double, 3> &behind,
                         const std::array<double, 3> &beyond)
    {
      const VaryingNeumann::Isotherm front = solution.isotherm(0);
      expect_relative(front.eta, front_and_fluxes[0], 1e-13);
      expect_relative(front.behind, front_and_fluxes[1], 1e-13);
      expect_relative(front.beyond, front_and_fluxes[2], 1e-12);
      const double beyond_by[] = {0.5, 1, 2};
      for(int i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(solution.temperature((i + 1) * front.eta / 4, 1), behind[i], 1e-12);
        EXPECT_NEAR(solution.temperature(front.eta + beyond_by[i], 1), beyond[i], 1e-12);
        EXPECT_NEAR(solution.temperature(3 * (front.eta + beyond_by[i]), 9), beyond[i],
                    1e-12);
      }
    }
  } // namespace

  /** Values computed elsewhere, by shooting in more digits than are printed. */
  TEST(VaryingNeumann, ConductivitiesThatDependOnTemperature)
  {
    expect_solution(
        VaryingNeumann(sharp(linear(1, -0.5), linear(1, 0.5), 1, 1, 1), -1, 0.5),
        {1.0512308810404, 1.0067592365388, 0.4811437960186},
        {-0.768180888811, -0.521716069712, -0.263911069911},
        {0.198712011826, 0.328577629905, 0.454857543780});
    expect_solution(
        VaryingNeumann(sharp(linear(2, -0.25), linear(1, -0.4), 1, 2, 3), -1, 1),
        {0.8294117644344, 2.5696285222606, 1.3255108756091},
        {-0.764030874979, -0.518058249953, -0.262973413240},
        {0.578489149147, 0.892119612205, 0.998354001222});
  }

  TEST(VaryingNeumann, IsNeumannsWhereNothingVaries)
  {
    for(const double far : {0.5, 0.})
    {
      const PlanarNeumann neumann(Material{}, -1, far);
      const VaryingNeumann freezing(unit(), -1, far), melting(unit(), 1, -far);
      EXPECT_TRUE(freezing.solid_at_origin());
      EXPECT_FALSE(melting.solid_at_origin());
      expect_relative(freezing.front(2), neumann.front(2), 1e-13);
      expect_relative(melting.front(2), neumann.front(2), 1e-13);
      for(double x = 0.15; x < 9; x += 0.37)
      {
        EXPECT_NEAR(freezing.temperature(x, 2), neumann.temperature(x, 2), 1e-13);
        EXPECT_NEAR(melting.temperature(x, 2), -neumann.temperature(x, 2), 1e-13);
        EXPECT_NEAR(freezing.heat_content(0.01, x, 2), neumann.heat_content(0.01, x, 2),
                    1e-12);
      }
      const PlanarNeumann melted(Material{}, 1, -far);
      EXPECT_NEAR(melting.heat_content(0, 5, 2), melted.heat_content(0, 5, 2), 1e-12);
    }
  }

  /** With a fraction that falls linearly all zones have constant properties: closed form.
   */
  TEST(VaryingNeumann, MeltingRangeOfTheClosedForm)
  {
    const VaryingNeumann equal(unit_range(1), -1, 0.5);
    expect_relative(equal.isotherm(-0.1).eta, 0.8303550783159416, 1e-12);
    expect_relative(equal.isotherm(0.1).eta, 1.138860439728383, 1e-12);

    // The solid volume is the integral of the fraction, and its rate the latent heat's.
    double volume = 0;
    const int panels = 20000;
    for(int i = 0; i < panels; ++i)
      volume += equal.solid_fraction((i + 0.5) * 2 / panels, 1) * 2 / panels;
    EXPECT_NEAR(equal.front(1), volume, 1e-8);
    EXPECT_NEAR(equal.solid_volume(0, 30, 1), equal.front(1), 1e-13);
    EXPECT_EQ(equal.solid_fraction(0.8, 1), 1);
    EXPECT_EQ(equal.solid_fraction(1.2, 1), 0);
  }

  /** What is liquid still at the solidus freezes there: a front within the range's end.
   */
  TEST(VaryingNeumann, RestFreezesAtTheSolidus)
  {
    const double rest = 0.4;
    for(const bool freezes : {true, false})
    {
      const VaryingNeumann solution(unit_range(1 - rest), freezes ? -1 : 0.5,
                                    freezes ? 0.5 : -1);
      const VaryingNeumann::Isotherm solidus = solution.isotherm(-0.1);
      EXPECT_NEAR((freezes ? 1 : -1) * (solidus.behind - solidus.beyond),
                  solidus.eta / 2 * rest, 1e-13);
    }
  }

  /** Heat that left through the wall is missing within. */
  TEST(VaryingNeumann, HeatBalance)
  {
    VaryingMaterial material = sharp(linear(2, -0.25), linear(1, 0.3), 1, 2, 3);
    material.liquidus = 0.2;
    material.solid_fraction
        = [](double temperature) { return 0.8 * std::pow(1 - temperature / 0.2, 2); };
    const VaryingNeumann solution(material, -1, 0.7);
    // The flux at the wall from the temperature's slope there, by differences.
    const double h = 1e-3;
    const auto t = [&](double x) { return solution.temperature(x, 1) + 1; };
    const double slope
        = (48 * t(h) - 36 * t(2 * h) + 16 * t(3 * h) - 3 * t(4 * h)) / (12 * h);
    const double at_wall = 2 * (1 + 0.25) * slope;
    const double before = solution.heat_content(0, 40, 0),
                 after = solution.heat_content(0, 40, 1);
    EXPECT_NEAR(before - after, 2 * at_wall, 1e-9);
  }

  TEST(VaryingNeumann, RejectsWhatItDoesNotSolve)
  {
    EXPECT_THROW(VaryingNeumann(unit(), 0.1, 0.5), InputError);
    EXPECT_THROW(VaryingNeumann(unit(), -1, -0.5), InputError);
    EXPECT_THROW(VaryingNeumann(unit_range(1), 0, 0.5), InputError);
    EXPECT_THROW(VaryingNeumann(unit_range(1), -1, 0), InputError);
    EXPECT_THROW(VaryingNeumann(sharp(linear(1, 2), constant(1), 1, 1, 1), -1, 0.5),
                 InputError);
    EXPECT_THROW(VaryingNeumann(sharp(constant(1), constant(1), 1, 1, 0), -1, 0.5),
                 InputError);
    Material lighter = water(917);
    EXPECT_THROW(VaryingMaterial::of(lighter), InputError);
  }
} // namespace meltfront::cases
