#include <cases/error.h>
#include <cases/exact/planar_neumann.h>
#include <particles/rkpm_tracked/tests/tracked_run.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    cases::Material material(double latent_heat, double liquid_conductivity,
                             double liquid_capacity)
    {
      cases::Material result;
      result.latent_heat = latent_heat;
      result.melting_temperature = 0;
      result.solid = {1, 1, 1};
      result.liquid = {liquid_conductivity, liquid_capacity, 1};
      return result;
    }

    /** Of the latent heat of the domain. */
    double lost(const Course &recorder, double latent_heat)
    {
      const cases::HeatBudget &heat = recorder.heat;
      return std::abs(heat.stored + heat.latent - heat.initial - heat.boundary
                      - heat.sources)
             / latent_heat;
    }

    // Liquid of a large heat capacity beside the wall is to freeze at once: what it would
    // give off if it cooled with the wall must not be booked.
    TEST(LineHeat, AWallThatJumpsCoolsNoLiquidThatIsToFreeze)
    {
      const double latent_heat = 2;
      for(const int n : {20, 40, 80})
      {
        cases::Scene scene = slab(material(latent_heat, 1, 19), 0, 0.01);
        scene.initial.temperature = cases::Field::uniform(0);
        scene.initial.solid_fraction_at_melting = 0;
        set_boundary(scene, Side::x_min, {});
        set_boundary(scene, Side::x_max,
                     {BoundaryKind::fixed_temperature,
                      {"", [](const cases::Position &, double t) { return -0.9 - t; }}});
        EXPECT_LT(lost(run(scene, n), latent_heat), 0.3 / n) << n;
      }
    }

    // What holds with no wall of given temperature: the wall's own changes at once.
    TEST(LineHeat, AWallThatExchangesHeatHasItsTemperatureFromTheFirstMomentOn)
    {
      const double latent_heat = 2;
      for(const int n : {20, 40, 80})
      {
        cases::Scene scene = slab(material(latent_heat, 1, 1), 0, 0.02);
        scene.initial.temperature = cases::Field::uniform(0.5);
        set_boundary(scene, Side::x_min, {});
        cases::Boundary wall{BoundaryKind::heat_transfer, cases::Field::uniform(-2)};
        wall.heat_transfer_coefficient = 300;
        set_boundary(scene, Side::x_max, wall);
        EXPECT_LT(lost(run(scene, n), latent_heat), 0.3 / n) << n;
      }
    }

    // 24/120 of 0.1 is not quite 0.02: a step as short as the difference, after the front
    // has appeared, once gave it any speed.
    TEST(LineHeat, AWallMayJumpAtATimeThatIsPlanned)
    {
      ASSERT_NE(24. / 120 * 0.1, 0.02);
      const auto melted = [](double jump)
      {
        cases::Scene scene = slab(material(1, 1, 2), 0, 0.1);
        scene.initial.temperature = cases::Field::uniform(-0.2);
        set_boundary(scene, Side::x_min, {});
        set_boundary(
            scene, Side::x_max,
            {BoundaryKind::fixed_temperature,
             {"",
              [jump](const cases::Position &, double t) { return t < jump ? -0.2 : 1.; },
              false,
              {jump}}});
        const Course recorder = run(scene, 40, {{"steps", "120"}});
        EXPECT_LT(lost(recorder, 1), 0.02) << jump;
        return 1 - recorder.solid.back();
      };
      EXPECT_NEAR(melted(0.02), melted(0.02 + 1e-7), 1e-5);
    }

    // Superheated solid melts towards a hot wall; after it has gone heat flows through
    // liquid from the first step on.
    TEST(LineHeat, AStepAfterAnEventBeginsWithTheHeatFlowAfterIt)
    {
      const double latent_heat = 30;
      cases::Scene scene = slab(material(latent_heat, 1, 1), 0, 2);
      scene.initial.front
          = cases::Field{"", [](const cases::Position &p, double) { return 0.8 - p[0]; }};
      scene.initial.temperature
          = {"", [](const cases::Position &p, double)
             { return p[0] < 0.8 ? 2 * (p[0] - 0.8) : -4 * (p[0] - 0.8); }};
      set_boundary(scene, Side::x_min, {});
      set_boundary(scene, Side::x_max, fixed_wall(5));
      const Course recorder = run(scene, 40);
      EXPECT_EQ(recorder.solid.back(), 0);
      EXPECT_LT(lost(recorder, latent_heat), 0.01);
    }

    // V h/a is 1.5e3 to 180 at first, 40 to 5 at the end: without the fit the front is
    // 14 % ahead, however many nodes there are.
    TEST(LineHeat, AFrontMeetsTheHeatOfALayerThatNoNodeResolves)
    {
      const double conductivity = 0.0035, warm = 0.06, cold = -0.61, end = 0.02;
      const cases::Material of = material(0.065, conductivity, 1);
      // Neumann's transcendental equation.
      double below = 0.1, above = 3;
      for(int k = 0; k < 80; ++k)
      {
        const double middle = (below + above) / 2, m = middle / std::sqrt(conductivity);
        const double scaled = m * (1 + 1 / (2 * m * m) - 1 / (2 * std::pow(m, 4)));
        const double drive = -cold * std::exp(-middle * middle)
                                 / (std::sqrt(std::numbers::pi) * std::erf(middle))
                             - warm * std::sqrt(conductivity) * scaled
                             - of.latent_heat * middle;
        (drive > 0 ? below : above) = middle;
      }
      const double thickness = 2 * below * std::sqrt(end);
      for(const int n : {20, 40, 80, 160})
      {
        cases::Scene scene = slab(of, 0, end);
        scene.initial.temperature = cases::Field::uniform(warm);
        set_boundary(scene, Side::x_min, {});
        set_boundary(scene, Side::x_max, fixed_wall(cold));
        EXPECT_NEAR(run(scene, n).solid.back(), thickness, 0.01 * thickness) << n;
      }
    }
  } // namespace
} // namespace meltfront::particles::rkpm_tracked
