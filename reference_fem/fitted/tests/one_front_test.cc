#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/fitted/fitted.h>
#include <reference_fem/fitted/setup.h>
#include <reference_fem/fitted/tests/support.h>

#include <cases/error.h>
#include <cases/exact/planar_neumann.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::fitted::tests
{
  namespace
  {
    using namespace reference_fem::tests;
    using cases::Side;

    /** k = c = rho = L = 1 with T_m = 0. */
    cases::Material plain()
    {
      cases::Material material;
      material.latent_heat = 1;
      return material;
    }

    /** A slab between x = 0 and 1 with solid up to a front and T = x - front. */
    cases::Scene two_phases(double front, double end)
    {
      cases::Scene scene = slab(plain(), 1, 0, 0, end);
      scene.initial.temperature
          = {"x - front",
             [front](const cases::Position &p, double) { return p[0] - front; }, false};
      set_boundary(scene, Side::x_min, fixed_wall(-front));
      set_boundary(scene, Side::x_max, fixed_wall(1 - front));
      return scene;
    }

    cases::Boundary transfer_wall(double ambient, double coefficient)
    {
      cases::Boundary wall{cases::BoundaryKind::heat_transfer,
                           cases::Field::uniform(ambient), false};
      wall.heat_transfer_coefficient = coefficient;
      return wall;
    }

    cases::Boundary varying(cases::BoundaryKind kind, std::function<double(double)> value,
                            std::vector<double> breakpoints = {})
    {
      return {kind,
              {"f(t)",
               [value = std::move(value)](const cases::Position &, double time)
               { return value(time); },
               false, std::move(breakpoints)},
              false};
    }

    /** The reason of a refusal; empty where the scene is run. */
    std::string refusal_of(const cases::Scene &scene, int n,
                           const OptionTexts &options = {})
    {
      try
      {
        run(scene, n, options);
      }
      catch(const cases::Refusal &refusal)
      {
        return refusal.what();
      }
      return {};
    }

    void expect_refusal(const cases::Scene &scene, const std::vector<std::string> &words)
    {
      const std::string reason = refusal_of(scene, 16);
      for(const std::string &word : words)
        EXPECT_NE(reason.find(word), std::string::npos) << word << ": " << reason;
    }

    TEST(HeatTransfer, CoolsLiquidAsItsEigenmode)
    {
      // T = T_a + cos(z (1 - x)) exp(-z^2 t) with z tan z = h/k.
      const double h = 1.3;
      double z = 0.9;
      for(int i = 0; i < 50; ++i)
        z -= (z * std::tan(z) - h) / (std::tan(z) + z / std::pow(std::cos(z), 2));
      cases::Scene scene = slab(plain(), 1, 0, 0, 0.5);
      scene.initial.temperature = {"mode",
                                   [z](const cases::Position &p, double)
                                   { return 1 + std::cos(z * (1 - p[0])); },
                                   false};
      set_boundary(scene, Side::x_min, transfer_wall(1, h));
      const Record record = run(scene, 8);
      for(std::size_t i = 0; i < record.temperature.size(); ++i)
        EXPECT_NEAR(record.temperature[i],
                    1 + std::cos(z * (1 - record.positions[0][i])) * std::exp(-z * z / 2),
                    1e-7);
      EXPECT_LT(record.worst_budget_defect(), 1e-12);
    }

    TEST(HeatTransfer, BalancesASteadyFront)
    {
      // 1/s = T_a/(1/h + 1 - s) with T_a = 1, h = 2.
      cases::Scene scene = two_phases(0.5, 30);
      set_boundary(scene, Side::x_min, fixed_wall(-1));
      set_boundary(scene, Side::x_max, transfer_wall(1, 2));
      const Record record = run(scene, 8, {{"steps", "60"}});
      EXPECT_NEAR(record.solid.back(), 0.75, 1e-8);
      EXPECT_LT(record.worst_budget_defect(), 1e-12);

      // In the plane the walls' rays share the account. No wall jumps: along a line cells
      // would be drawn to it.
      const cases::Boundary cooled = varying(cases::BoundaryKind::fixed_temperature,
                                             [](double t) { return -0.5 - 5 * t; });
      cases::Scene plane = box(plain(), 2, {}, {1, 0.5, 0}, 0, 0.1);
      plane.initial.temperature = scene.initial.temperature;
      set_boundary(scene, Side::x_min, cooled);
      set_boundary(plane, Side::x_min, cooled);
      set_boundary(plane, Side::x_max, transfer_wall(1, 2));
      scene.end_time = 0.1;
      const OptionTexts options{{"degree", "2"}, {"steps", "10"}};
      const Record line = run(scene, 8, options), many = run(plane, 8, options);
      EXPECT_NEAR(many.solid.back(), 0.5 * line.solid.back(), 1e-11);
      EXPECT_LT(many.worst_budget_defect(), 1e-12);
    }

    TEST(HeatTransfer, MeltsASlabOfGallium)
    {
      cases::Material gallium;
      gallium.solid = {40.6, 372, 5907};
      gallium.liquid = {29, 382, 5907};
      gallium.latent_heat = 80160;
      gallium.melting_temperature = 29.76;
      cases::Scene scene = slab(gallium, 0.02, 20, 0, 3600);
      set_boundary(scene, Side::x_min, transfer_wall(60, 500));
      const Record record = run(scene, 16), finer = run(scene, 32);
      EXPECT_EQ(record.front_points[0].size(), 0u);
      EXPECT_NEAR(record.solid.back(), 0, 1e-12);
      EXPECT_NEAR(record.heat.boundary / finer.heat.boundary, 1, 1e-5);
      EXPECT_LT(record.worst_budget_defect(), 1e-12);
      for(const double temperature : record.temperature)
        EXPECT_GT(temperature, 40.);
    }

    TEST(OneFront, ASecondOneInMoreDimensionsIsRefusedByName)
    {
      cases::Scene plane = box(plain(), 2, {}, {1, 0.5, 0}, 0, 0.5);
      plane.initial.temperature = two_phases(0.5, 0.5).initial.temperature;
      set_boundary(plane, Side::x_min, fixed_wall(-0.5));
      // Nothing tells in advance that a flux freezes the far wall.
      set_boundary(plane, Side::x_max, flux_wall(-3));
      const std::string reason = refusal_of(plane, 8, {{"degree", "2"}, {"steps", "50"}});
      for(const char *word : {"t = 0.", "x_max", "second"})
        EXPECT_NE(reason.find(word), std::string::npos) << word << ": " << reason;
    }

    TEST(OneFront, IsJoinedByASecondOneFromAWallThatPasses)
    {
      // The far wall passes the melting temperature at t = 0.2.
      cases::Scene ramp = two_phases(0.5, 0.3);
      set_boundary(ramp, Side::x_max,
                   varying(cases::BoundaryKind::fixed_temperature,
                           [](double t) { return 0.5 - 2.5 * t; }));
      const Record coarse = run(ramp, 16), fine = run(ramp, 32);
      ASSERT_EQ(coarse.front_points[0].size(), 2u);
      for(std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(coarse.front_points[0][k], fine.front_points[0][k], 1e-7);
      EXPECT_LT(fine.worst_budget_defect(), 1e-12);
      const Course other = course_of(*make_fem_enthalpy(), ramp, 500);
      EXPECT_NEAR(fine.solid.back(), other.solid.back(), 2e-4);
    }

    TEST(OneFront, AWallIsLookedAtWithinAStep)
    {
      // Beyond the melting temperature for 1e-4, within a step of 1e-2; the contract
      // samples at other times.
      const auto dip = [](double t) { return std::abs(t - 0.2503) < 5e-5 ? -0.1 : 0.5; };
      cases::Scene scene = two_phases(0.5, 0.5);
      set_boundary(
          scene, Side::x_max,
          varying(cases::BoundaryKind::fixed_temperature, dip, {0.25025, 0.25035}));
      // A dip that is smooth, between the ends of steps.
      const auto smooth = [](double t)
      { return 0.5 - 0.6 * std::exp(-std::pow((t - 0.2526) / 1e-3, 2)); };
      cases::Scene without_word = scene;
      set_boundary(without_word, Side::x_max,
                   varying(cases::BoundaryKind::fixed_temperature, smooth));
      for(const cases::Scene &seen : {scene, without_word})
      {
        const Record record = run(seen, 16);
        EXPECT_TRUE(
            std::ranges::any_of(record.notes, [](const std::string &note)
                                { return note.find("x_max") != std::string::npos; }));
        // What freezes melts again.
        EXPECT_EQ(record.front_points[0].size(), 1u);
        EXPECT_LT(record.worst_budget_defect(), 1e-12);
      }
    }

    TEST(OneFront, ASourceThatTurnsIsRefused)
    {
      ExactScene scene = line_sink_disk();
      const auto power = scene.scene.sources[0].power;
      scene.scene.sources[0].power
          = [power](double t) { return (t < 2e5 ? 1 : -1) * power(t); };
      expect_refusal(scene.scene, {"front"});
    }

    TEST(OneFront, PhasesFollowTheFrontOfTheScene)
    {
      // Half of the solid is at the melting temperature and stays solid.
      cases::Scene at_melting = slab(plain(), 1, 0, 0, 0.1);
      at_melting.initial.temperature
          = {"min(0.5 - x, 0)",
             [](const cases::Position &p, double) { return std::min(0.5 - p[0], 0.); },
             false};
      at_melting.initial.solid_fraction_at_melting = 1;
      EXPECT_NEAR(run(at_melting, 8).solid.back(), 1, 1e-12);

      // Undercooled liquid without a germ stays liquid, also at its walls.
      cases::Scene undercooled = slab(plain(), 1, -0.5, 0, 0.1);
      undercooled.initial.front = cases::Field::uniform(1);
      set_boundary(undercooled, Side::x_min, flux_wall(-0.1));
      EXPECT_NEAR(run(undercooled, 8).solid.back(), 0, 1e-12);
    }

    TEST(LaterFront, StartsWhereAWallJumps)
    {
      // Neumann's solution from t = 0.02 on.
      const cases::PlanarNeumann exact(plain(), -1, 0.5);
      cases::Scene scene = slab(plain(), 4, 0.5, 0, 0.07);
      set_boundary(scene, Side::x_min,
                   varying(cases::BoundaryKind::fixed_temperature,
                           [](double t) { return t < 0.02 ? 0.5 : -1; }, {0.02}));
      EXPECT_NEAR(run(scene, 32).solid.back() / exact.front(0.05), 1, 1e-7);
    }

    TEST(LaterFront, OfAStrongFluxIsResolved)
    {
      // The wall freezes within the first of 50 steps.
      cases::Scene scene = slab(plain(), 1, 0.05, 0, 0.5);
      set_boundary(scene, Side::x_min, flux_wall(-1));
      const Record coarse = run(scene, 16), fine = run(scene, 32);
      EXPECT_NEAR(coarse.solid.back() / fine.solid.back(), 1, 1e-6);
      EXPECT_LT(fine.worst_budget_defect(), 1e-12);
      // All heat that was drawn: 0.5.
      EXPECT_NEAR(fine.heat.boundary, -0.5, 1e-12);
    }

    TEST(Pulses, EnterByTheirTimeIntegral)
    {
      // 1e2 for 1e-4, within a step of 1e-2, with and without word of it.
      const auto pulse = [](double t) { return t > 0.2343 && t < 0.2344 ? 1e2 : 0.; };
      for(const bool told : {true, false})
        for(const char *scheme : {"radau5", "bdf2"})
        {
          cases::Scene scene = two_phases(0.5, 0.5);
          set_boundary(scene, Side::x_max,
                       varying(cases::BoundaryKind::flux, pulse,
                               told ? std::vector<double>{0.2343, 0.2344}
                                    : std::vector<double>{}));
          // No heat leaves through the other wall.
          set_boundary(scene, Side::x_min, {});
          const Record record = run(scene, 16, {{"time_scheme", scheme}});
          EXPECT_NEAR(record.heat.boundary, 0.01, told ? 1e-10 : 1e-6) << scheme;
          EXPECT_LT(record.worst_budget_defect(), 1e-12);
        }
    }

    TEST(Grading, ThatMakesCellsVanishIsRefused)
    {
      const cases::Scene scene = two_phases(0.4, 0.1);
      for(const int n : {64, 1000})
        EXPECT_NE(refusal_of(scene, n, {{"grading", "10"}}).find("smallest"),
                  std::string::npos);
      EXPECT_EQ(refusal_of(scene, 16, {{"grading", "10"}}), "");
      EXPECT_EQ(refusal_of(scene, 64, {{"grading", "1.5"}}), "");
    }

    TEST(Evidence, CountsWhatTheTimeSchemeDid)
    {
      const auto counts = [](const OptionTexts &options)
      { return run(two_phases(0.4, 0.1), 8, options).cost.evidence; };
      EXPECT_EQ(counts({{"time_scheme", "bdf3"}}).at("steps of Radau that start BDF"), 2);
      EXPECT_EQ(counts({{"time_scheme", "bdf2"}}).at("steps that fell back to Radau"), 0);
      EXPECT_EQ(
          counts({{"tolerance", "1e-9"}}).count("steps repeated by the step control"),
          1u);
      EXPECT_EQ(counts({}).at("events that changed the mesh"), 0);
    }

    TEST(Effects, CostWhatTheirCodeTakes)
    {
      cases::Scene scene = two_phases(0.4, 0.1);
      set_boundary(scene, Side::x_max, transfer_wall(1, 1));
      for(const cases::EffectCost &cost : run(scene, 8).cost.effects)
      {
        const bool own = cost.effect == cases::Effect::phase_change
                         || cost.effect == cases::Effect::wall_temperature
                         || cost.effect == cases::Effect::robin_wall;
        EXPECT_EQ(cost.bytes > 0, own) << to_string(cost.effect);
        EXPECT_GT(cost.calls, 0) << to_string(cost.effect);
        EXPECT_EQ(cost.seconds > 0, own) << to_string(cost.effect);
      }
    }

    TEST(Demand, IsOfTheOrderOfTheRun)
    {
      const auto method = make_fem_fitted();
      const auto demand = [&](const cases::Scene &scene, int n)
      {
        cases::Resolution resolution;
        resolution.n = n;
        resolution.options = cases::Options(method->option_declarations());
        return method->demand(scene, cases::effects_called_for(scene), resolution);
      };
      EXPECT_EQ(demand(two_phases(0.4, 0.1), 100).steps, 200);
      EXPECT_LT(demand(two_phases(0.4, 0.1), 1000).bytes, 1e9);
      EXPECT_GT(demand(wavy_box(2, 0.1), 10000).bytes, 1e11);
      EXPECT_GT(demand(wavy_box(3, 0.1), 200).bytes, 1e11);
    }
  } // namespace
} // namespace meltfront::reference_fem::fitted::tests
