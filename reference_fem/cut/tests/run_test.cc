#include <cases/error.h>
#include <reference_fem/cut/cut.h>
#include <reference_fem/cut/options.h>
#include <reference_fem/cut/tests/cut_support.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    TEST(FemCut, SinkInADiskFromCold)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      // With fewer cells the front ends five cells from the sink where it is seeded at
      // three: too short a run for an order.
      const std::vector<int> n{32, 40, 48, 64};
      std::vector<double> errors, defects;
      for(const int cells : n)
      {
        const Course course = run_cut(sink_in_disk(exact), cells);
        EXPECT_TRUE(grows(course));
        EXPECT_EQ(course.cost.capped_steps, 0);
        errors.push_back(front_error(course, *exact));
        defects.push_back(course.budget_defect.back());
      }
      EXPECT_LE(errors.back(), 2e-4);
      EXPECT_GE(fitted_order(n, errors), 1.7);
      // The scheme does not conserve heat by construction: its defect is an error.
      EXPECT_LE(defects.back(), 5e-5);
      EXPECT_GE(fitted_order(n, defects), 1.3);
    }

    TEST(FemCut, DisksMergeAndTheirAreaOnlyGrows)
    {
      const Course course = run_cut(disks({{-0.36, 0, 0}, {0.36, 0, 0}}, 0.3), 40);
      EXPECT_TRUE(grows(course));
      EXPECT_EQ(course.cost.capped_steps, 0);
      EXPECT_GT(course.solid.back(), 0.95);
      EXPECT_LE(course.budget_defect.back(), 2e-3);
      EXPECT_NEAR(moment_of_solid(course), 0, 1e-6);
    }

    /** The unit square, half of it solid, with a wall that is warmer at once. */
    Scene switched_on(double wall)
    {
      Scene scene;
      scene.domain.shape = DomainShape::box;
      scene.domain.dimension = 2;
      scene.domain.upper = {1, 1, 0};
      scene.material.latent_heat = 1;
      scene.material.solid = scene.material.liquid = {1, 1, 1};
      scene.initial.temperature
          = {"x - 0.5", [](const Position &p, double) { return p[0] - 0.5; }};
      for(const Side side : {Side::x_min, Side::x_max, Side::y_min, Side::y_max})
        scene.boundaries[static_cast<std::size_t>(side)] = Boundary();
      const auto hold = [&scene](Side side, double temperature)
      {
        Boundary &boundary = *scene.boundaries[static_cast<std::size_t>(side)];
        boundary.kind = BoundaryKind::fixed_temperature;
        boundary.value = Field::uniform(temperature);
      };
      hold(Side::x_min, -0.5);
      hold(Side::x_max, wall);
      scene.end_time = 0.2;
      return scene;
    }

    TEST(FemCut, AWallThatIsSwitchedOnIsDamped)
    {
      const double fine = run_cut(switched_on(2), 48).solid.back();
      EXPECT_LT(fine, 0.45);
      for(const int n : {16, 24, 32})
      {
        const Course course = run_cut(switched_on(2), n);
        EXPECT_NEAR(course.solid.back(), fine, 2e-3) << n;
        EXPECT_GE(course.cost.evidence.at("steps of backward Euler"), 4) << n;
      }
      // Where nothing jumps one step of backward Euler is enough.
      EXPECT_EQ(run_cut(switched_on(0.5), 16).cost.evidence.at("steps of backward Euler"),
                1);
    }

    TEST(FemCut, MirrorAndQuarterTurn)
    {
      const Position lower{-0.5, -0.5, 0}, upper{0.5, 0.5, 0};
      const OptionTexts options{{"fewest_steps", "20"}};
      const auto area = [&](double x, double y) {
        return run_cut(disks({{x, y, 0}}, 0.02, lower, upper), 24, options).solid;
      };
      const std::vector<double> one = area(0.11, 0.07);
      EXPECT_EQ(one, area(0.11, 0.07));
      for(const auto &other : {area(-0.11, 0.07), area(-0.07, 0.11)})
      {
        ASSERT_EQ(one.size(), other.size());
        for(std::size_t i = 0; i < one.size(); ++i)
          EXPECT_NEAR(one[i], other[i], 1e-9);
      }
    }

    TEST(FemCut, APhaseMayVanish)
    {
      Scene scene = disks({{0.03, 0.01, 0}}, 0.2, {-0.5, -0.5, 0}, {0.5, 0.5, 0});
      scene.sources.clear();
      scene.initial.temperature = {"warm",
                                   [](const Position &p, double)
                                   {
                                     const double r
                                         = std::hypot(p[0] - 0.03, p[1] - 0.01) - 0.15;
                                     return r < 0 ? 0. : std::min(5 * r, 1.);
                                   },
                                   false};
      const Course course = run_cut(scene, 24, {{"fewest_steps", "60"}, {"cfl", "0.5"}});
      EXPECT_EQ(course.solid.back(), 0);
      EXPECT_LE(course.budget_defect.back(), 0.02);
    }

    std::string why_refused(const Scene &scene, int n)
    {
      try
      {
        run_cut(scene, n);
      }
      catch(const Refusal &refusal)
      {
        return refusal.what();
      }
      return {};
    }

    // Scenes 8815199-669, -825 and, nearly, -940 of crosscheck.
    TEST(FemCut, SaysWhyTemperaturesLeaveTheirBounds)
    {
      const auto cone = [](double radius, double solid, double liquid, const Position &at)
      {
        return Field{"cone",
                     [=](const Position &p, double)
                     {
                       const double r = std::hypot(p[0] - at[0], p[1] - at[1]) - radius;
                       return r < 0 ? solid * r : liquid * r;
                     },
                     false};
      };
      Material material = normalised_material();
      material.melting_temperature = 0;
      material.latent_heat = 5.172;
      material.liquid.conductivity = 0.2693;
      Scene corner = box(material, 2, {0, 0, 0}, {1, 1, 0}, 0, 0.1);
      corner.initial.temperature = cone(0.1982, 0.9489, 1.045, {0.5639, 0.409, 0});
      set_boundary(corner, Side::x_min,
                   {BoundaryKind::fixed_temperature, Field::uniform(0.3373)});
      set_boundary(
          corner, Side::y_min,
          {BoundaryKind::fixed_temperature,
           {"ramp", [](const Position &, double t) { return 0.4825 + 4.074 * t; }}});
      EXPECT_NE(why_refused(corner, 20).find("beside a corner"), std::string::npos);

      material.latent_heat = 0.2637;
      material.liquid.conductivity = 26.09;
      Scene last = ball(material, 2, 1, 0, 0.02);
      last.initial.temperature = cone(0.4362, 0.6617, 1.24, {});
      EXPECT_NE(why_refused(last, 20).find("the last solid is"), std::string::npos);

      material.latent_heat = 0.8018;
      material.liquid.conductivity = 0.001571;
      Scene sudden = box(material, 2, {0, 0, 0}, {1, 1, 0}, 0, 0.3);
      sudden.initial.temperature = {"plane", [](const Position &p, double)
                                    { return 1.216 * std::max(0., p[0] - 0.3689); }};
      sudden.initial.front
          = Field{"plane", [](const Position &p, double) { return p[0] - 0.3689; }};
      set_boundary(sudden, Side::x_max, {BoundaryKind::flux, Field::uniform(-0.08)});
      set_boundary(sudden, Side::y_min, {BoundaryKind::flux, Field::uniform(-0.028)});
      EXPECT_NE(why_refused(sudden, 34).find("what a wall gives jumped"),
                std::string::npos);
    }

    long fewest_steps(const Scene &scene, int n, const OptionTexts &options = {})
    {
      return cut::options_for(scene, resolution_of(*make_fem_cut(), n, options))
          .fewest_steps;
    }

    // Errors of time are to fall with those of space, and what swings is to be resolved.
    TEST(FemCut, ThereAreAsManyStepsAsCellsOrMoreWhereSomethingVaries)
    {
      Scene scene = switched_on(1);
      set_boundary(scene, Side::x_max,
                   {BoundaryKind::fixed_temperature, Field::uniform(1)});
      EXPECT_EQ(fewest_steps(scene, 64), 64);
      EXPECT_EQ(fewest_steps(scene, 8), 50);
      EXPECT_EQ(fewest_steps(scene, 48, {{"fewest_steps", "7"}}), 7);
      EXPECT_EQ(fewest_steps(scene, 48, {{"degree", "2"}}), 100);
      const Field swinging{"sin(9*t)",
                           [](const Position &, double t) { return std::sin(9 * t); }};
      Scene with_release = scene;
      with_release.volumetric_source = swinging;
      EXPECT_EQ(fewest_steps(with_release, 48), 100);
      set_boundary(scene, Side::x_max, {BoundaryKind::flux, swinging});
      EXPECT_EQ(fewest_steps(scene, 48), 100);
      EXPECT_EQ(fewest_steps(scene, 148), 148);
      scene.boundaries[static_cast<std::size_t>(Side::x_max)]->exact = true;
      EXPECT_EQ(fewest_steps(scene, 64), 64);
    }

    std::string scheme_in_record(const OptionTexts &options)
    {
      Scene scene = disks({{0.03, 0.01, 0}}, 1e-4);
      OptionTexts given{{"scheme", "automatic"}, {"fewest_steps", "1"}};
      given.insert(given.end(), options.begin(), options.end());
      for(const Parameter &parameter : run_cut(scene, 40, given).description.parameters)
        if(parameter.name == "scheme")
          return parameter.value;
      return {};
    }

    TEST(FemCut, TheSchemeFollowsFromTheOptionsAndIsTold)
    {
      EXPECT_TRUE(scheme_in_record({}).starts_with("conservative"));
      for(const OptionTexts &own :
          {OptionTexts{{"degree", "2"}}, {{"refinement", "1"}}, {{"solves", "3"}}})
      {
        const std::string told = scheme_in_record(own);
        EXPECT_TRUE(told.starts_with("extension")) << told;
        EXPECT_NE(told.find(own.front().first), std::string::npos) << told;
      }
      EXPECT_TRUE(scheme_in_record({{"scheme", "extension"}}).starts_with("extension"));
    }

    TEST(FemCut, RefusesWhatItCannotStartFrom)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      Scene uniform = sink_in_disk(exact);
      uniform.sources.clear();
      EXPECT_THROW(run_cut(uniform, 24), Refusal);            // one phase
      EXPECT_THROW(run_cut(sink_in_disk(exact), 8), Refusal); // coarser than the front
      Scene felt = sink_in_disk(exact);
      felt.sources[0].position = {0.4, 0, 0};
      set_boundary(felt, Side::outer, {});
      EXPECT_THROW(run_cut(felt, 24), Refusal); // a wall beside the seed
      Scene pulsed = sink_in_disk(exact);
      pulsed.sources[0].power = [steady = pulsed.sources[0].power(0)](double time)
      { return time > 1 && time < 2 ? 50 * steady : steady; };
      pulsed.sources[0].energy = [steady = pulsed.sources[0].power(0)](double time)
      { return steady * (time + 49 * std::clamp(time - 1, 0., 1.)); };
      EXPECT_THROW(run_cut(pulsed, 24), Refusal); // before the seed
      Scene liquid_source = disks({{0, 0, 0}}, 0.1);
      liquid_source.sources[0].position = {0.5, 0, 0};
      EXPECT_THROW(run_cut(liquid_source, 40), Refusal);
      EXPECT_THROW(run_cut(disks({{0, 0, 0}}, 0.1), 8), Refusal); // unresolved
      EXPECT_THROW(run_cut(slab(water(), 1, 10, 0, 1), 16), Refusal);
      Scene periodic = disks({{0, 0, 0}}, 0.1);
      set_boundary(periodic, Side::x_min, {BoundaryKind::periodic, {}, false});
      set_boundary(periodic, Side::x_max, {BoundaryKind::periodic, {}, false});
      EXPECT_THROW(run_cut(periodic, 40), Refusal);
    }

    /** Heat at the end of a disk of melt in a square with a flux (W/m^2) into one wall.
     */
    HeatBudget heat_with_flux(double (*flux)(double time),
                              std::vector<double> breakpoints)
    {
      Scene scene = disks({{0, 0, 0}}, 0.1, {-0.5, -0.5, 0}, {0.5, 0.5, 0});
      set_boundary(
          scene, Side::x_max,
          {BoundaryKind::flux,
           {"", [flux](const cases::Position &, double time) { return flux(time); },
            false, std::move(breakpoints)}});
      return run_cut(scene, 40, {{"fewest_steps", "20"}}).heat;
    }

    // Within a step of about 5e-3 s; q times 1e-4 s.
    TEST(FemCut, APulseOfFluxBringsItsEnergy)
    {
      const HeatBudget without = heat_with_flux([](double) { return 0.; }, {});
      const HeatBudget with = heat_with_flux(
          [](double t) { return t >= 0.071 && t < 0.0711 ? 200. : 0.; }, {0.071, 0.0711});
      EXPECT_NEAR(with.boundary - without.boundary, 0.02, 1e-9);
      EXPECT_NEAR(with.stored + with.latent - without.stored - without.latent, 0.02,
                  2e-4);
    }

    // The scheme weighs the fluxes of two steps; the book has the integral.
    TEST(FemCut, AGrowingFluxIsBookedAsItsIntegral)
    {
      const HeatBudget heat
          = heat_with_flux([](double t) { return 5 * std::exp(30 * t); }, {});
      const HeatBudget without = heat_with_flux([](double) { return 0.; }, {});
      const double end = 0.1;
      EXPECT_NEAR(heat.boundary - without.boundary, 5. / 30 * std::expm1(30 * end), 1e-6);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
