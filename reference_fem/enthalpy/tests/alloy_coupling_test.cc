#include <cases/error.h>
#include <cases/exact/mushy_layer.h>
#include <reference_fem/enthalpy/tests/alloy_support.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    /** Between a cold wall and one that the exact solution knows. */
    Scene against(std::shared_ptr<const MushyLayer> &exact, double cold, double d,
                  double eutectic)
    {
      Scene scene = melt(0.5, start_temperature, 91800);
      scene.alloy->solutes[0].diffusivity = d;
      scene.alloy->eutectic_temperature = eutectic;
      exact = std::make_shared<MushyLayer>(scene.material, *scene.alloy,
                                           std::vector<double>{bulk}, cold,
                                           start_temperature);
      set_boundary(scene, Side::x_min, fixed_wall(cold));
      set_boundary(scene, Side::x_max, exact_wall(exact));
      return scene;
    }

    double temperature_rms(const RunRecord &record, const MushyLayer &exact)
    {
      double sum = 0, weight = 0;
      for(std::size_t i = 0; i < record.weights.size(); ++i)
      {
        const double off
            = record.temperature[i] - exact.temperature(record.positions[0][i], 91800);
        sum += record.weights[i] * off * off;
        weight += record.weights[i];
      }
      return std::sqrt(sum / weight);
    }

    struct Level
    {
      double worst; ///< K, at n = 240
      double order;
    };

    void expect_convergence(double cold, double d, double eutectic, const Level &expected)
    {
      std::shared_ptr<const MushyLayer> exact;
      const Scene scene = against(exact, cold, d, eutectic);
      const std::vector<int> n{30, 60, 120, 240};
      std::vector<double> errors;
      for(const int cells : n)
      {
        const RunRecord record = run(scene, cells);
        expect_closed(record);
        errors.push_back(temperature_rms(record, *exact));
      }
      EXPECT_LE(errors.back(), expected.worst);
      EXPECT_GE(fitted_order(n, errors), expected.order);
    }

    TEST(MushyLayer, WithoutDiffusion)
    {
      expect_convergence(wall, 0, -1e300, {2e-3, 1.5});
    }

    TEST(MushyLayer, WithDiffusion)
    {
      // A layer of a millimetre at the wall loses its solute: no cell resolves it.
      expect_convergence(wall, diffusivity, -1e300, {1.5e-2, 0.7});
    }

    TEST(MushyLayer, WithAEutecticFront)
    {
      expect_convergence(-25, 0, -18, {4e-2, 0.9});
    }

    /** Mush everywhere, smooth in every quantity, through which solute spreads fast. */
    Scene smooth_mush()
    {
      constexpr double length = 0.05;
      Scene scene = melt(length, 0, 20000);
      scene.alloy->solutes[0].diffusivity = 1e-8;
      const auto wave = [](double x) { return std::cos(std::numbers::pi * x / length); };
      scene.initial.temperature = along_x([wave](double x) { return -10 - 3 * wave(x); });
      scene.initial.concentration
          = {along_x([wave](double x) { return 0.1 + 0.03 * wave(2 * x); })};
      return scene;
    }

    TEST(AlloyCoupling, IsOfSecondOrderInTime)
    {
      const Scene scene = smooth_mush();
      const auto with = [&](int steps, const char *scheme)
      {
        const RunRecord record
            = run(scene, 20, {{"steps", std::to_string(steps)}, {"time_scheme", scheme}});
        expect_closed(record);
        return record;
      };
      const RunRecord reference = with(12800, "bdf2");
      const auto orders = [&](const char *scheme)
      {
        const std::vector<int> steps{50, 100, 200, 400};
        std::vector<double> temperature, concentration;
        for(const int count : steps)
        {
          const RunRecord record = with(count, scheme);
          double t = 0, c = 0;
          for(std::size_t i = 0; i < record.temperature.size(); ++i)
          {
            t = std::max(t, std::abs(record.temperature[i] - reference.temperature[i]));
            c = std::max(
                c, std::abs(record.concentration[0][i] - reference.concentration[0][i]));
          }
          temperature.push_back(t);
          concentration.push_back(c);
        }
        return std::pair(fitted_order(steps, temperature),
                         fitted_order(steps, concentration));
      };
      const auto [temperature, concentration] = orders("bdf2");
      EXPECT_GE(temperature, 1.8);
      EXPECT_GE(concentration, 1.8);
      const auto [first, first_concentration] = orders("backward-euler");
      EXPECT_NEAR(first, 1, 0.2);
      EXPECT_NEAR(first_concentration, 1, 0.2);
    }

    TEST(AlloyCoupling, SaltyWaterDissolvesIceAndCools)
    {
      // All at the same temperature; no wall takes heat.
      Scene scene = melt(0.02, -5, 2e5);
      scene.alloy->solutes[0].diffusivity = diffusivity;
      scene.initial.concentration
          = {along_x([](double x) { return x < 0.01 ? 0.02 : 0.3; })};
      for(const char *scheme : {"bdf2", "backward-euler"})
      {
        const RunRecord record = run(scene, 64, {{"time_scheme", scheme}});
        expect_closed(record);
        EXPECT_EQ(record.heat.boundary, 0);
        const double coldest
            = *std::min_element(record.lowest.begin(), record.lowest.end());
        EXPECT_LT(coldest, -5.5);
        EXPECT_GT(coldest, -slope * 0.3);
        EXPECT_LE(*std::max_element(record.highest.begin(), record.highest.end()),
                  -5 + 1e-6);
        EXPECT_LT(total_solid(record), 0.01 * (1 - slope * 0.02 / 5));
      }
    }

    TEST(AlloyCoupling, AMushLeftToItselfEvensOut)
    {
      Scene scene = melt(0.02, 0, 3e7);
      scene.alloy->solutes[0].diffusivity = diffusivity * 10;
      scene.initial.temperature
          = along_x([](double x) { return -4 + 7 * std::sin(1300 * x * x + 900 * x); });
      scene.initial.concentration
          = {along_x([](double x) { return 0.1 + 0.09 * std::cos(777 * x); })};
      const RunRecord record = run(scene, 40);
      expect_closed(record);
      const std::size_t n = record.temperature.size();
      for(std::size_t i = 1; i < n; ++i)
      {
        EXPECT_NEAR(record.temperature[i], record.temperature[0], 1e-6);
        EXPECT_NEAR(record.concentration[0][i] / (1 - record.solid_fraction[i]),
                    record.concentration[0][0] / (1 - record.solid_fraction[0]), 1e-7);
      }
    }

    TEST(AlloyCoupling, SoluteSpreadsIntoWhatIsPure)
    {
      // Half of it water and ice, half of it brine, with and without a eutectic.
      for(const double eutectic : {-8., -1e300})
      {
        Scene scene = melt(0.05, 0, 20000);
        scene.alloy->solutes[0].diffusivity = diffusivity;
        scene.alloy->eutectic_temperature = eutectic;
        scene.initial.temperature
            = along_x([](double x) { return -1 + 8 * std::sin(310 * x + 1); });
        scene.initial.concentration
            = {along_x([](double x) { return x < 0.025 ? 0. : 0.3; })};
        const RunRecord record = run(scene, 40);
        expect_closed(record);
        EXPECT_GE(*std::min_element(record.concentration[0].begin(),
                                    record.concentration[0].end()),
                  0);
        EXPECT_GT(record.concentration[0][19], 0.01);
      }
    }

    TEST(AlloyCoupling, AStripIsTheSlab)
    {
      std::shared_ptr<const MushyLayer> exact;
      Scene scene = against(exact, wall, diffusivity, -1e300);
      const RunRecord line = run(scene, 24), strip = run(scene, 24, {{"dimension", "2"}});
      ASSERT_EQ(line.front.size(), strip.front.size());
      for(std::size_t i = 0; i < line.front.size(); ++i)
        EXPECT_NEAR(line.front[i], strip.front[i], 1e-9);
      EXPECT_NEAR(line.heat.boundary, strip.heat.boundary,
                  1e-8 * std::abs(line.heat.boundary));
      expect_closed(strip);
    }

    TEST(AlloyCoupling, ADiskIsItsRadius)
    {
      Scene scene = ball(solvent(), 2, 0.1, start_temperature, 10000);
      scene.alloy.emplace();
      scene.alloy->solutes.push_back({"salt", slope});
      scene.alloy->solutes[0].diffusivity = diffusivity;
      scene.alloy->crystal_density = 917;
      scene.initial.concentration = {Field::uniform(bulk)};
      set_boundary(scene, Side::outer, fixed_wall(wall));
      const RunRecord radius = run(scene, 64),
                      disk = run(scene, 32, {{"dimension", "2"}});
      expect_closed(disk);
      EXPECT_NEAR(total_solid(disk), total_solid(radius), 0.02 * total_solid(radius));
    }

    const EffectCost *cost_of(const RunRecord &record, Effect effect)
    {
      for(const EffectCost &cost : record.cost.effects)
        if(cost.effect == effect)
          return &cost;
      return nullptr;
    }

    TEST(AlloyEffects, CostOnlyWhatTheSceneCallsFor)
    {
      Scene scene = melt(0.5, start_temperature, 91800);
      set_boundary(scene, Side::x_min, fixed_wall(wall));
      const RunRecord still = run(scene, 40);
      ASSERT_NE(cost_of(still, Effect::solute), nullptr);
      EXPECT_EQ(cost_of(still, Effect::solute_diffusion), nullptr);
      EXPECT_EQ(cost_of(still, Effect::eutectic), nullptr);
      EXPECT_GT(cost_of(still, Effect::solute)->calls, still.cost.steps - 1);
      scene.effect_choices[Effect::solute_diffusion] = EffectChoice::on;
      const RunRecord asked = run(scene, 40);
      EXPECT_EQ(cost_of(asked, Effect::solute_diffusion)->calls, 0);
      EXPECT_EQ(cost_of(asked, Effect::solute_diffusion)->bytes, 0);
      scene.effect_choices.clear();
      scene.alloy->solutes[0].diffusivity = diffusivity;
      const RunRecord spreading = run(scene, 40);
      EXPECT_GT(cost_of(spreading, Effect::solute_diffusion)->calls, 0);
      EXPECT_GT(cost_of(spreading, Effect::solute_diffusion)->bytes, 0);
      EXPECT_GT(cost_of(spreading, Effect::solute)->bytes,
                cost_of(still, Effect::solute)->bytes);
      scene.alloy->solutes.push_back({"none of it", 10});
      scene.initial.concentration.push_back(Field::uniform(0));
      EXPECT_EQ(cost_of(run(scene, 40), Effect::solute)->bytes,
                cost_of(spreading, Effect::solute)->bytes);
    }

    TEST(AlloyEffects, WhatIsNotSimulatedIsRefused)
    {
      Scene cold = melt(0.5, start_temperature, 91800);
      cold.material.latent_heat = 0;
      EXPECT_THROW(run(cold, 10), Refusal);
      for(const double nonsense : {-0.1, 1.5, std::nan("")})
      {
        Scene wrong = melt(0.5, start_temperature, 91800);
        wrong.initial.concentration
            = {along_x([nonsense](double x) { return x < 0.2 ? nonsense : 0.1; })};
        EXPECT_THROW(run(wrong, 10), InputError);
      }
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
