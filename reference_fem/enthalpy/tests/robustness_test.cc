#include <cases/error.h>
#include <cases/exact/planar_neumann.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    struct HardCase
    {
      std::string name;
      Material material;
      double worst_front; ///< relative, at n = 256 over a length of 2
    };

    std::vector<HardCase> hard_cases()
    {
      std::vector<HardCase> result;
      const auto add = [&](const std::string &name, double worst, auto change)
      {
        Material material = normalised_material();
        change(material);
        result.push_back({name, material, worst});
      };
      add("Stefan number 0.01", 4e-3, [](Material &m) { m.latent_heat = 81; });
      add("Stefan number 0.1", 2e-3, [](Material &m) { m.latent_heat = 8.1; });
      add("Stefan number 10", 3e-3, [](Material &m) { m.latent_heat = 0.081; });
      add("Stefan number 100", 7e-3, [](Material &m) { m.latent_heat = 0.0081; });
      add("liquid conducts 1e-9", 6e-3,
          [](Material &m) { m.liquid.conductivity = 1e-9; });
      add("liquid conducts 1e-3", 5e-3,
          [](Material &m) { m.liquid.conductivity = 1e-3; });
      add("liquid conducts 1e2", 5e-3, [](Material &m) { m.liquid.conductivity = 1e2; });
      add("liquid conducts 1e3", 4e-2, [](Material &m) { m.liquid.conductivity = 1e3; });
      add("liquid stores 10", 9e-3,
          [](Material &m) { m.liquid.specific_heat_capacity = 10; });
      add("liquid stores 100", 7e-2,
          [](Material &m) { m.liquid.specific_heat_capacity = 100; });
      return result;
    }

    TEST(HardCases, ExtremeMaterialsConvergeInEveryStep)
    {
      for(const HardCase &hard : hard_cases())
        for(const bool started : {false, true})
        {
          SCOPED_TRACE(hard.name + (started ? ", started" : ", discontinuous start"));
          const auto exact = std::make_shared<PlanarNeumann>(
              hard.material, normalised_wall, normalised_far);
          Scene scene = slab(hard.material, 2, normalised_far, started ? 0.01 : 0., 0.25);
          set_boundary(scene, Side::x_min, fixed_wall(normalised_wall));
          set_boundary(scene, Side::x_max, exact_wall(exact));
          if(started)
            start_from(scene, exact);
          const RunRecord record = run(scene, 256, {}, exact.get());
          EXPECT_EQ(record.cost.capped_steps, 0);
          EXPECT_LE(record.worst_budget_defect(), 1e-13);
          EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
          EXPECT_LE(record.worst_front_error(0.13), hard.worst_front);
        }
    }

    TEST(HardCases, GoodConductorsCarryHeatWithoutRoundOff)
    {
      // The Fourier number of a step is 3e10 in the phase that conducts better.
      for(const bool solid : {false, true})
      {
        Material material = normalised_material();
        (solid ? material.solid : material.liquid).conductivity = 1e9;
        Scene scene = slab(material, 2, normalised_far, 0, 0.25);
        set_boundary(scene, Side::x_min, fixed_wall(normalised_wall));
        set_boundary(scene, Side::x_max, fixed_wall(normalised_far));
        const RunRecord record = run(scene, 256);
        EXPECT_EQ(record.cost.capped_steps, 0);
        EXPECT_LE(record.worst_budget_defect(), 1e-13);
        EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
        // Steady: the conductor's flow is set by its resistance alone.
        EXPECT_GT(std::abs(record.heat.boundary) + record.heat.latent, 0.5);
      }
    }

    TEST(HardCases, LongStepsAreHalvedRatherThanGivenUp)
    {
      Scene scene = slab(normalised_material(), 1, normalised_far, 0, 0.25);
      set_boundary(scene, Side::x_min, fixed_wall(normalised_wall));
      const RunRecord fine = run(scene, 1024);
      const RunRecord coarse
          = run(scene, 1024, {{"steps", "10"}, {"start_halvings", "0"}});
      const RunRecord capped
          = run(scene, 1024, {{"steps", "10"}, {"iteration_limit", "3"}});
      EXPECT_EQ(fine.cost.capped_steps, 0);
      EXPECT_GT(capped.cost.capped_steps, 0);
      EXPECT_GT(capped.statistics.halvings, 0);
      for(const RunRecord *record : {&coarse, &capped})
      {
        EXPECT_LE(record->statistics.graph_inconsistency, 1e-11);
        EXPECT_LE(record->worst_budget_defect(), 1e-13);
        EXPECT_NEAR(record->front.back(), fine.front.back(), 5e-3);
      }
    }

    TEST(HardCases, AStepThatNeverConvergesStopsTheRun)
    {
      Material material = normalised_material();
      material.latent_heat = 1e-3;
      Scene scene = slab(material, 1, 0.9, 0, 0.25);
      set_boundary(scene, Side::x_min, fixed_wall(1000));
      try
      {
        run(scene, 1024,
            {{"iteration_limit", "1"}, {"steps", "1"}, {"start_halvings", "0"}});
        FAIL()
            << "hundreds of cells melt in the shortest step, one iteration melts a few";
      }
      catch(const NumericalError &error)
      {
        EXPECT_EQ(error.method, "fem-enthalpy");
        EXPECT_EQ(error.step, 1);
        EXPECT_LT(error.time, 1e-4);
      }
    }

    TEST(HardCases, ValuesThatAreNotFiniteStopTheRun)
    {
      Scene scene = slab(normalised_material(), 1, normalised_far, 0, 0.25);
      set_boundary(scene, Side::x_min,
                   varying_wall(
                       [](double time) {
                         return time > 0.1 && time < 0.11
                                    ? std::numeric_limits<double>::quiet_NaN()
                                    : 0.5;
                       }));
      EXPECT_THROW(run(scene, 64), NumericalError);
    }

    TEST(HardCases, ALiquidLayerOneCellThickVanishes)
    {
      const int n = 64;
      for(const auto &[n_dimension, length] : {std::pair{"1", 1.}, std::pair{"2", 1.}})
      {
        Scene scene = slab(normalised_material(), length, 0.4, 0, 0.2);
        scene.initial.temperature = {"layer",
                                     [](const Position &p, double) {
                                       return std::abs(p[0] - 0.5) < 0.6 / n ? 1.3 : 0.4;
                                     },
                                     false};
        const RunRecord record = run(scene, n, {{"dimension", n_dimension}});
        EXPECT_NEAR(record.front.front(), 1 - 1. / n, 1e-12);
        EXPECT_NEAR(record.front.back(), 1, 1e-12);
        EXPECT_TRUE(std::is_sorted(record.front.begin(), record.front.end()));
        EXPECT_EQ(record.cost.capped_steps, 0);
        EXPECT_LE(record.worst_budget_defect(), 1e-13);
        EXPECT_EQ(record.heat.boundary, 0);
        EXPECT_GE(*std::min_element(record.lowest.begin(), record.lowest.end()),
                  0.4 - 1e-12);
      }
    }

    TEST(HardCases, SuddenWallsKeepTheBounds)
    {
      // BDF2 alone swings beyond the wall's temperatures here.
      long euler_steps = 0;
      for(const int n : {8, 32, 128})
        for(const double latent_heat : {0., 1.})
        {
          Material material = normalised_material();
          material.latent_heat = latent_heat;
          material.liquid.conductivity = 1e3;
          Scene scene = slab(material, 1, 1.2, 0, 0.25);
          set_boundary(
              scene, Side::x_min,
              varying_wall([](double time)
                           { return std::fmod(time, 0.05) > 0.025 ? 0.2 : 1.2; }));
          const RunRecord record = run(scene, n);
          euler_steps += record.statistics.euler_steps;
          EXPECT_GE(*std::min_element(record.lowest.begin(), record.lowest.end()), 0.198);
          EXPECT_LE(*std::max_element(record.highest.begin(), record.highest.end()),
                    1.202);
          EXPECT_LE(record.worst_budget_defect(), 1e-13);
        }
      EXPECT_GT(euler_steps, 0);
    }

    TEST(HardCases, EverythingEndsAtTheMeltingPoint)
    {
      // The heat of the liquid side melts a part of the solid side: temperatures vanish
      // under the round-off of the latent heat.
      Material material = normalised_material();
      material.liquid.conductivity = 1e3;
      Scene scene = slab(material, 1, 1.2, 0, 100);
      scene.initial.temperature
          = {"jump", [](const Position &p, double) { return p[0] < 0.5 ? 0.2 : 1.8; },
             false};
      const RunRecord record = run(scene, 32);
      EXPECT_EQ(record.cost.capped_steps, 0);
      EXPECT_NEAR(record.lowest.back(), 1, 1e-9);
      EXPECT_NEAR(record.highest.back(), 1, 1e-9);
      EXPECT_LE(record.worst_budget_defect(), 1e-13);
      EXPECT_NEAR(record.heat.latent, record.heat.initial, 1e-9);
    }

    TEST(HardCases, TheFrontTurnsBackWithTheWall)
    {
      Scene scene = slab(normalised_material(), 1, 1.1, 0, 1);
      set_boundary(
          scene, Side::x_min,
          varying_wall([](double time)
                       { return 1 - 0.8 * std::sin(2 * std::numbers::pi * time); }));
      std::vector<double> peaks;
      for(const int n : {64, 128, 256, 512})
      {
        const RunRecord record = run(scene, n);
        EXPECT_EQ(record.cost.capped_steps, 0);
        EXPECT_LE(record.worst_budget_defect(), 1e-13);
        peaks.push_back(*std::max_element(record.front.begin(), record.front.end()));
        EXPECT_GT(peaks.back(), 0.2);
        // A second front melts in from the wall after t = 1/2.
        EXPECT_LT(record.front.back(), peaks.back() - 0.1);
      }
      EXPECT_LT(std::abs(peaks[3] - peaks[2]), std::abs(peaks[1] - peaks[0]));
      EXPECT_LT(std::abs(peaks[3] - peaks[2]), 2e-3);
    }

    TEST(Effects, AbsentOnesCostNothing)
    {
      Scene scene = slab(normalised_material(), 1, normalised_far, 0, 0.05);
      set_boundary(scene, Side::x_min, fixed_wall(0.5));
      const RunRecord record = run(scene, 32);
      std::vector<Effect> paid;
      for(const EffectCost &cost : record.cost.effects)
      {
        paid.push_back(cost.effect);
        EXPECT_GT(cost.calls, 0);
        EXPECT_GT(cost.bytes, 0);
      }
      EXPECT_EQ(paid,
                (std::vector<Effect>{Effect::phase_change, Effect::wall_temperature}));
    }

    TEST(Effects, WithNothingToActOnChangeNothing)
    {
      Scene scene = slab(normalised_material(), 1, normalised_far, 0, 0.05);
      set_boundary(scene, Side::x_min, fixed_wall(0.5));
      Scene loaded = scene;
      for(const Effect effect : {Effect::phase_conductivity, Effect::phase_heat_capacity,
                                 Effect::heat_sources, Effect::wall_flux})
        loaded.effect_choices[effect] = EffectChoice::on;
      loaded.sources.push_back(
          {{0.5, 0, 0}, "0", [](double) { return 0.; }, [](double) { return 0.; }});
      EXPECT_EQ(run(scene, 48).temperature, run(loaded, 48).temperature);
      Scene without = scene;
      without.material.latent_heat = 0;
      Scene forced = without;
      forced.effect_choices[Effect::phase_change] = EffectChoice::on;
      EXPECT_EQ(run(without, 48).temperature, run(forced, 48).temperature);
    }

    TEST(Effects, LiquidMotionIsRefusedInThePlane)
    {
      Material material = water();
      material.solid.density = 917;
      const Scene scene = box(material, 2, {}, {1, 1, 0}, 10, 1000);
      NoObserver nobody;
      EXPECT_THROW(solve(*make_fem_enthalpy(), scene, {}, nobody), Refusal);
    }

    TEST(Method, RefusesDimensionsAndMeshesThatTheSceneDoesNotHave)
    {
      const Scene square = box(water(), 2, {}, {1, 1, 0}, 1, 100);
      EXPECT_THROW(run(square, 8, {{"dimension", "3"}}), Refusal);
      const Scene disk = ball(water(), 2, 1, 1, 100);
      EXPECT_THROW(run(disk, 20, {{"dimension", "2"}}), Refusal);
      EXPECT_NO_THROW(run(disk, 20));
    }

    TEST(Method, TheResultDependsNeitherOnThreadsNorOnThePreconditioner)
    {
      Scene scene = box(normalised_material(), 2, {}, {1, 0.7, 0}, 1.2, 0.05);
      set_boundary(scene, Side::x_min, fixed_wall(0.2));
      set_boundary(scene, Side::y_max, fixed_wall(0.4));
      const RunRecord one = run(scene, 40);
      EXPECT_EQ(one.temperature, run(scene, 40, {{"threads", "2"}}).temperature);
      const RunRecord amg = run(scene, 40, {{"preconditioner", "amg"}});
      for(std::size_t i = 0; i < one.temperature.size(); ++i)
        EXPECT_NEAR(one.temperature[i], amg.temperature[i], 1e-10);
      EXPECT_LE(one.worst_budget_defect(), 1e-13);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
