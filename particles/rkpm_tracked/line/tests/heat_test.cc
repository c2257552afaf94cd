#include <cases/error.h>
#include <cases/exact/planar_neumann.h>
#include <particles/rkpm_tracked/tests/tracked_run.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

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

    // A pulse shorter than heat takes through a cell, while the wall's phase melts and
    // freezes: 5e-2 of its heat once got lost beside the wall.
    TEST(LineHeat, AllHeatOfAPulseIsFound)
    {
      for(const int n : {20, 40})
      {
        cases::Scene scene = slab(material(1, 2, 1), 0, 0.1);
        scene.initial.temperature = cases::Field::uniform(-0.3);
        set_boundary(scene, Side::x_min, {});
        set_boundary(scene, Side::x_max,
                     {BoundaryKind::flux,
                      {"",
                       [](const cases::Position &, double t)
                       { return t >= 0.02 && t < 0.0204 ? 1000. : 0.; },
                       false,
                       {0.02, 0.0204}}});
        const Course recorder = run(scene, n);
        EXPECT_GT(*std::ranges::max_element(recorder.solid), 0.99);
        EXPECT_LT(*std::ranges::min_element(recorder.solid), 0.95);
        EXPECT_NEAR(recorder.heat.boundary, 0.4, 1e-10);
        EXPECT_LT(lost(recorder, 1), 2e-5) << n;
      }
    }

    // Steps differ, nodes change their phase, the area grows: the heat of all cells still
    // is what came in, but for that of the layers in which phases appear.
    TEST(LineHeat, APipeKeepsItsHeatWhateverItsWallsDo)
    {
      std::vector<double> solid;
      for(const int n : {20, 40, 80, 160})
      {
        cases::Scene scene = slab(material(1, 1, 1), 0, 0.12);
        scene.symmetry = cases::Symmetry::cylindrical;
        scene.domain.shape = cases::DomainShape::shell;
        scene.domain.dimension = 2;
        scene.domain.inner_radius = 0.5;
        scene.domain.radius = 1;
        scene.material.solid.conductivity = 2;
        scene.initial.temperature = cases::Field::uniform(0.4);
        cases::Boundary inner{BoundaryKind::heat_transfer, cases::Field::uniform(-1.5)};
        inner.heat_transfer_coefficient = 8;
        set_boundary(scene, Side::inner, inner);
        set_boundary(scene, Side::outer,
                     {BoundaryKind::flux, {"", [](const cases::Position &, double t) {
                                             return -1.5 * std::sin(40 * t);
                                           }}});
        const Course recorder = run(scene, n);
        EXPECT_LT(recorder.worst_budget_defect(), 1e-4) << n;
        solid.push_back(recorder.solid.back());
      }
      // Two phases appear, and a third beside the second.
      EXPECT_LT(std::abs(solid[1] - solid[3]), 1e-3 * solid[3]);
      EXPECT_LT(std::abs(solid[2] - solid[3]), std::abs(solid[1] - solid[3]) / 2);
    }

    // Cells that grow from a wall are to be halved with all others: as long as they were
    // not, errors of n = 14 to 40 were alike, and no refining told of them.
    TEST(LineHeat, ErrorsBetweenTwoWallsThatFreezeFallAsTheSquareOfTheSpacing)
    {
      cases::Scene scene = slab(material(1, 0.5, 1.2), 0, 0.05);
      scene.material.solid.density = scene.material.liquid.density = 0.9;
      scene.symmetry = cases::Symmetry::spherical;
      scene.domain.shape = cases::DomainShape::shell;
      scene.domain.dimension = 3;
      scene.domain.inner_radius = 0.3;
      scene.domain.radius = 1;
      scene.initial.temperature = cases::Field::uniform(0.3);
      cases::Boundary inner{BoundaryKind::heat_transfer, cases::Field::uniform(-1.5)};
      inner.heat_transfer_coefficient = 20;
      set_boundary(scene, Side::inner, inner);
      set_boundary(scene, Side::outer, {BoundaryKind::flux, cases::Field::uniform(-1.5)});
      constexpr double by_fitted_elements = 0.73288974; // n = 14, 20 and 40 agree in it
      const std::vector<int> n{10, 14, 20, 28, 40};
      std::vector<double> errors;
      for(const int cells : n)
        errors.push_back(std::abs(run(scene, cells).solid.back() - by_fitted_elements));
      EXPECT_LE(errors.back(), 5e-4);
      EXPECT_GE(test_support::fitted_order(n, errors), 1.7);
    }

    // A layer of liquid of one cell, with nodes where the jumps of temperature about it
    // cannot be told: what fails there is refused by what is too thin.
    TEST(LineHeat, APhaseOfOneCellThatCannotBeFollowedIsRefusedByName)
    {
      cases::Scene scene = slab(material(1, 1, 1), 0, 0.03);
      scene.initial.temperature = {"layer", [](const cases::Position &p, double)
                                   { return p[0] > 0.49 && p[0] < 0.515 ? 0.01 : -0.1; }};
      for(const Side side : {Side::x_min, Side::x_max})
        set_boundary(scene, side, fixed_wall(-0.1));
      expect_refusal(scene, 42, "spacings thick: take n");
      EXPECT_NEAR(run(scene, 84).solid.back(), 1, 1e-9);
    }

    // Nodes stand where bodies touch, and beside them; from nodes that lie anywhere the
    // front was off by a share of the spacing.
    TEST(LineHeat, BodiesThatTouchMeltOrFreezeAsTheyDoWithoutEnd)
    {
      constexpr double end = 0.006, at = 0.417;
      for(const auto &[solid, liquid] : {std::pair(-0.9, 0.3), std::pair(-0.2, 0.8)})
      {
        cases::Scene scene = slab({}, 0, end);
        scene.material.melting_temperature = 0;
        scene.initial.temperature = step_along_x(at, solid, liquid);
        for(const Side side : {Side::x_min, Side::x_max})
          set_boundary(scene, side, {});
        const double way = 2 * speed_of_contact(solid, liquid) * std::sqrt(end);
        const std::vector<int> n{20, 28, 40, 80};
        std::vector<double> errors;
        for(const int cells : n)
        {
          const Course course = run(scene, cells);
          EXPECT_LE(course.worst_budget_defect(), 1e-9);
          errors.push_back(std::abs(course.solid.back() - at - way));
        }
        // Measured: 1.2 % and 0.3 %.
        EXPECT_LE(errors.front(), 0.015 * std::abs(way));
        EXPECT_LE(errors.back(), 0.004 * std::abs(way));
        EXPECT_GE(test_support::fitted_order(n, errors), 0.9);
      }
    }

    // Two jumps, one of them within a phase, in balls and pipes: heat is that of the
    // scene.
    TEST(LineHeat, WhatJumpsAtTheStartIsAllThere)
    {
      using std::numbers::pi;
      for(const int dimension : {1, 2, 3})
        for(const int n : {10, 16})
        {
          cases::Scene scene
              = dimension == 1 ? slab({}, 0, 1e-4) : ball({}, dimension, 1, 0, 1e-4);
          scene.material.melting_temperature = 0;
          scene.material.latent_heat = 0.5;
          scene.initial.temperature = {"if(x < 0.3, -1, if(x < 0.62, 0.2, 0.7))",
                                       [](const cases::Position &p, double)
                                       {
                                         const double x = std::hypot(p[0], p[1], p[2]);
                                         return x < 0.3 ? -1. : x < 0.62 ? 0.2 : 0.7;
                                       }};
          if(dimension == 1)
            set_boundary(scene, Side::x_min, {});
          set_boundary(scene, dimension == 1 ? Side::x_max : Side::outer, {});
          const auto volume = [&](double x) {
            return dimension == 1   ? x
                   : dimension == 2 ? pi * x * x
                                    : 4 * pi / 3 * x * x * x;
          };
          const double heat = -volume(0.3) + 0.7 * (volume(0.62) - volume(0.3))
                              + 1.2 * (volume(1) - volume(0.62));
          EXPECT_NEAR(run(scene, n).heat.initial, heat, 0.08 / n * heat) << dimension;
        }
    }

    // Above a wall that holds a temperature its heat is told by its cell.
    TEST(LineHeat, AWallThatTurnsColdGivesWhatIsFound)
    {
      cases::Scene scene = slab(material(1, 1, 1), 0, 0.15);
      scene.initial.temperature = cases::Field::uniform(0.3);
      set_boundary(
          scene, Side::x_min,
          {BoundaryKind::fixed_temperature,
           {"",
            [](const cases::Position &, double t) { return t < 0.05 ? 0.3 : -0.5; },
            false,
            {0.05}}});
      set_boundary(scene, Side::x_max, flux_wall(-3));
      const Course recorder = run(scene, 40);
      EXPECT_GT(recorder.solid.back(), 0.3);
      EXPECT_LT(recorder.worst_budget_defect(), 2e-4);
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

    /** At rest k T' = flux - release x in the liquid, whose wall gives the flux, and the
     * front stands where the solid conducts all of it to its held wall. */
    TEST(LineHeat, ReleaseBesideAFrontIsAllConductedAway)
    {
      const double flux = 0.5, density = 6, cold = -2;
      cases::Scene scene = slab(material(1, 2, 0.8), 0, 4);
      scene.initial.temperature = cases::Field::uniform(0.4);
      scene.volumetric_source = cases::Field::uniform(density);
      set_boundary(scene, Side::x_min, {BoundaryKind::flux, cases::Field::uniform(flux)});
      set_boundary(scene, Side::x_max, fixed_wall(cold));
      // -cold = (flux + density X)/k_s (1 - X) + density (1 - X)^2/(2 k_s), k_s = 1
      double below = 0, above = 1;
      for(int i = 0; i < 100; ++i)
      {
        const double x = (below + above) / 2, way = 1 - x;
        const double warmer = way * (flux + density * x + density * way / 2);
        (warmer > -cold ? below : above) = x;
      }
      for(const int n : {20, 40, 80})
      {
        const Course recorder = run(scene, n);
        EXPECT_NEAR(recorder.front_points[0].at(0), below, 1e-6) << n;
        EXPECT_LE(recorder.worst_budget_defect(), 1e-3) << n;
      }
    }

    // V h/a is 1.5e3 to 180 at first, 40 to 5 at the end: without the fit collocation's
    // front is 14 % ahead, however many nodes there are. With balances it lags by what
    // half a cell holds.
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
        EXPECT_NEAR(run(scene, n, {{"form", "collocation"}}).solid.back(), thickness,
                    0.01 * thickness)
            << n;
        const Course balances = run(scene, n);
        EXPECT_NEAR(balances.solid.back(), thickness, 0.2 / n) << n;
        EXPECT_LE(balances.worst_budget_defect(), 1e-8) << n;
      }
    }

    // The layer of warm liquid is a thousandth of a cell: the front halts before each
    // node, and formulas that look back ran past that place, from which it came back.
    TEST(LineHeat, AFrontThatHaltsBeforeNodesDoesNotTurnBack)
    {
      cases::Material of = material(0.01, 1, 1);
      of.liquid.conductivity = 1e-3;
      for(const int n : {18, 20, 22, 24, 30, 32})
      {
        cases::Scene scene = slab(of, 0, 0.012);
        scene.initial.temperature = {"begun", [](const cases::Position &p, double)
                                     { return p[0] < 0.1 ? 10 * p[0] - 1 : 0.2; }};
        set_boundary(scene, Side::x_min, fixed_wall(-1));
        set_boundary(scene, Side::x_max, {});
        const Course course = run(scene, n);
        for(std::size_t i = 1; i < course.solid.size(); ++i)
          EXPECT_LE(course.solid[i - 1] - course.solid[i], 1e-9) << n << ' ' << i;
      }
    }

    // Liquid comes to cold solid that conducts up to 1e9 times worse: nodes hold a cell's
    // heat each when the front reaches them. Up to a tenth of the heat once got lost
    // there.
    TEST(LineHeat, AFrontThatMeltsABadConductorLosesNoHeat)
    {
      const double cold = -1, hot = 1, end = 0.15;
      for(const double conductivity : {1e-2, 1e-3, 1e-9})
        for(const double latent_heat : {0.1, 1.})
        {
          cases::Material of = material(latent_heat, 1, 1);
          of.solid.conductivity = conductivity;
          const double molten = cases::PlanarNeumann(of, hot, cold).front(end);
          for(const int n : {20, 40, 80, 160})
          {
            cases::Scene scene = slab(of, 0, end);
            scene.initial.temperature = cases::Field::uniform(cold);
            set_boundary(scene, Side::x_max, {});
            set_boundary(scene, Side::x_min, fixed_wall(hot));
            const Course held = run(scene, n);
            EXPECT_LE(held.worst_budget_defect(), 1e-7) << conductivity << ' ' << n;
            EXPECT_NEAR(1 - held.solid.back(), molten, 0.3 / n) << conductivity;
            set_boundary(scene, Side::x_min,
                         {BoundaryKind::flux, cases::Field::uniform(3)});
            EXPECT_LE(run(scene, n).worst_budget_defect(), 2e-5) << conductivity;
          }
        }
    }
  } // namespace
} // namespace meltfront::particles::rkpm_tracked
