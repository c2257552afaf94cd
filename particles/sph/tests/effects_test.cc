#include <cases/error.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    using cases::Effect;
    using cases::EffectChoice;

    const std::vector<const char *> methods{"sph", "sph-2005"};

    std::unique_ptr<cases::Method> make(const std::string &name)
    {
      return name == "sph" ? make_sph() : make_sph_2005();
    }

    const cases::EffectCost *find(const Outcome &outcome, Effect effect)
    {
      const auto &costs = outcome.cost.effects;
      const auto found = std::find_if(costs.begin(), costs.end(),
                                      [effect](const cases::EffectCost &cost)
                                      { return cost.effect == effect; });
      return found == costs.end() ? nullptr : &*found;
    }

    void expect_same_temperature(const Outcome &a, const Outcome &b)
    {
      ASSERT_EQ(a.temperature.size(), b.temperature.size());
      const double scale = b.highest - b.lowest;
      for(std::size_t i = 0; i < a.temperature.size(); ++i)
        ASSERT_NEAR(a.temperature[i], b.temperature[i], 1e-12 * scale) << i;
    }

    // An effect that a scene does not call for costs no call and no byte.
    TEST(Effects, AbsentOnesCostNothing)
    {
      Problem conduction = plane_freezing();
      conduction.scene.material.latent_heat = 0;
      conduction.exact = nullptr;
      for(const char *name : methods)
        for(const Problem &problem :
            {plane_freezing(), plane_freezing_water(), line_sink(20000), conduction})
        {
          const Outcome outcome = run(*make(name), problem, 20);
          const auto effects = cases::effects_called_for(problem.scene);
          for(const Effect effect : cases::all_effects())
          {
            const cases::EffectCost *cost = find(outcome, effect);
            if(effects.contains(effect))
            {
              ASSERT_NE(cost, nullptr) << cases::to_string(effect);
              EXPECT_GT(cost->calls, 0) << cases::to_string(effect);
              EXPECT_GT(cost->bytes, 0) << cases::to_string(effect);
              EXPECT_GE(cost->seconds, 0);
            }
            else if(cost != nullptr)
            {
              EXPECT_EQ(cost->calls, 0) << cases::to_string(effect);
              EXPECT_EQ(cost->bytes, 0) << cases::to_string(effect);
            }
          }
        }
    }

    // An effect with nothing to act on leaves the temperature alone.
    TEST(Effects, OnesWithNothingToActOnChangeNothing)
    {
      Problem walls = plane_freezing();
      Problem sink = line_sink(40000);
      for(const char *name : methods)
        for(Problem *problem : {&walls, &sink})
        {
          if(problem == &sink) // the same conductivities and heat capacities
            problem->scene.material.liquid = problem->scene.material.solid;
          const Outcome plain = run(*make(name), *problem, 20);
          for(const Effect effect :
              {Effect::phase_conductivity, Effect::phase_heat_capacity,
               Effect::heat_sources, Effect::wall_temperature, Effect::wall_flux})
          {
            Problem more = *problem;
            more.scene.effect_choices[effect] = EffectChoice::on;
            expect_same_temperature(run(*make(name), more, 20), plain);
          }
        }
    }

    TEST(Effects, ASourceWithoutPowerChangesNothing)
    {
      Problem problem = plane_freezing();
      const Outcome plain = run(*make_sph(), problem, 40);
      problem.scene.sources
          = {{{0.5, 0, 0}, "0", [](double) { return 0.; }, [](double) { return 0.; }}};
      const Outcome with_source = run(*make_sph(), problem, 40);
      ASSERT_NE(find(with_source, Effect::heat_sources), nullptr);
      expect_same_temperature(with_source, plain);
    }

    // Latent heat on, but far below the melting point: pure conduction.
    TEST(Effects, PhaseChangeOutOfReachChangesNothing)
    {
      Problem problem;
      problem.scene = slab(unit_material(5), 1, 1, 0.02, fixed_wall(0), {});
      const Outcome with_phases = run(*make_sph(), problem, 40);
      problem.scene.effect_choices[Effect::phase_change] = EffectChoice::off;
      const Outcome without = run(*make_sph(), problem, 40);
      // The step is shorter where fronts may come: compare with the exact solution.
      for(const Outcome *outcome : {&with_phases, &without})
        for(std::size_t i = 0; i < outcome->temperature.size(); ++i)
          EXPECT_NEAR(outcome->temperature[i],
                      std::erf(outcome->position_x[i] / (2 * std::sqrt(0.02))), 2e-3);
    }

    TEST(Effects, LiquidMotionIsRefusedBesideSources)
    {
      cases::Material lighter_ice = water();
      lighter_ice.solid.density = 917;
      Problem problem;
      problem.scene = unit_box(2, lighter_ice, 10, 1);
      problem.scene.sources = {steady_sink({}, 1)};
      EXPECT_THROW(run(*make_sph(), problem, 20), cases::Refusal);
    }

    /** All at the melting temperature: only the scene's front tells ice from water. */
    TEST(Effects, TheSceneSaysWhereItsFrontStarts)
    {
      Problem problem;
      problem.scene = unit_box(2, unit_material(), 0, 0.01);
      problem.scene.initial.front
          = cases::Field{"", [](const cases::Position &p, double)
                         { return p[0] * p[0] + p[1] * p[1] - 0.09; }};
      const Outcome outcome = run(*make_sph(), problem, 20);
      double ice = 0;
      for(std::size_t i = 0; i < outcome.weights.size(); ++i)
        ice += outcome.weights[i] * outcome.solid_fraction[i];
      EXPECT_NEAR(ice, std::numbers::pi * 0.09, 2e-3 * 0.09);
    }

    TEST(Effects, UndercooledLiquidIsRefused)
    {
      Problem problem;
      problem.scene = unit_box(2, unit_material(), -1, 0.01);
      problem.scene.initial.front = cases::Field::uniform(1);
      const auto refusal = [&problem]() -> std::string
      {
        try
        {
          run(*make_sph(), problem, 20);
        }
        catch(const cases::Refusal &error)
        {
          return error.what();
        }
        return "runs";
      };
      EXPECT_EQ(refusal(), "sph does not simulate metastable_phase (liquid is "
                           "undercooled at the start)");
    }

    TEST(Effects, EveryOneCarriesItsTime)
    {
      const Outcome outcome = run(*make_sph(), plane_freezing_water(), 320);
      double sum = 0;
      for(const cases::EffectCost &cost : outcome.cost.effects)
        sum += cost.seconds;
      EXPECT_GT(sum, 0);
    }
  } // namespace
} // namespace meltfront::particles::testing
