#include <reference_fem/enthalpy/tests/alloy_support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    Scene freezing(double end)
    {
      Scene scene = melt(0.5, start_temperature, end);
      set_boundary(scene, Side::x_min, fixed_wall(wall));
      return scene;
    }

    /** The similarity solution without diffusion, integrated by others in 40 digits. */
    struct Known
    {
      double x, temperature;
    };
    const std::vector<Known> early = {{0.01, -13.9501373},
                                      {0.02, -11.2024044},
                                      {0.03, -8.1325002},
                                      {0.05, 0.3579717},
                                      {0.10, 12.1696694}};
    const std::vector<Known> late
        = {{0.02, -14.5821358}, {0.05, -11.4996983}, {0.08, -8.0194987},
           {0.10, -4.8980446},  {0.15, 2.9078308},   {0.20, 8.2876093}};

    double temperature_at(const RunRecord &record, double x)
    {
      for(std::size_t i = 0; i < record.temperature.size(); ++i)
        if(std::abs(record.positions[0][i] - x) < 1e-9)
          return record.temperature[i];
      ADD_FAILURE() << "there is no node at " << x;
      return NAN;
    }

    double table_rms(const RunRecord &record, const std::vector<Known> &table)
    {
      double sum = 0;
      for(const Known &known : table)
        sum += std::pow(temperature_at(record, known.x) - known.temperature, 2);
      return std::sqrt(sum / table.size());
    }

    TEST(AlloyFreezing, MeetsTheSimilaritySolution)
    {
      const std::vector<int> n{50, 100, 200, 400};
      std::vector<double> errors, errors_early;
      for(const int cells : n)
      {
        const RunRecord record = run(freezing(91800), cells);
        expect_closed(record);
        errors.push_back(table_rms(record, late));
        errors_early.push_back(table_rms(run(freezing(13200), cells), early));
      }
      EXPECT_LE(errors[2], 4e-3);
      EXPECT_LE(errors[3], 1e-3);
      EXPECT_GE(fitted_order(n, errors), 1.5);
      EXPECT_LE(errors_early[3], 8e-3);
      EXPECT_GE(fitted_order(n, errors_early), 1.5);
    }

    TEST(AlloyFreezing, ConductivityScalesTime)
    {
      Scene one = freezing(91800);
      one.material.liquid.conductivity = one.material.solid.conductivity = 1;
      Scene quarter = one;
      quarter.material.liquid.conductivity = quarter.material.solid.conductivity = 0.25;
      quarter.end_time *= 4;
      expect_same(run(one, 60), run(quarter, 60), 1e-9);
    }

    TEST(AlloyFreezing, WithoutSoluteItIsThePureSubstance)
    {
      Scene pure = freezing(91800);
      pure.alloy.reset();
      pure.initial.concentration.clear();
      Scene empty = freezing(91800);
      empty.initial.concentration = {Field::uniform(0)};
      empty.effect_choices[Effect::solute] = EffectChoice::on;
      const RunRecord a = run(pure, 60), b = run(empty, 60);
      expect_same(a, b, 0);
      EXPECT_EQ(a.cost.work, b.cost.work);
      EXPECT_TRUE(b.concentration[0].empty());
    }

    TEST(AlloyFreezing, LittleSoluteIsNearlyThePureSubstance)
    {
      Scene pure = freezing(91800);
      pure.alloy.reset();
      pure.initial.concentration.clear();
      // Per kilogram crystals take up the melt's space: the front is that of equal
      // densities.
      Scene dilute = freezing(91800);
      dilute.alloy->crystal_density = 0;
      dilute.initial.concentration = {Field::uniform(1e-9)};
      const RunRecord a = run(pure, 120), b = run(dilute, 120);
      EXPECT_NEAR(total_solid(b), total_solid(a), 1e-4 * total_solid(a));
      expect_closed(b);
    }

    TEST(AlloyFreezing, TwoSolutesAreOneOfTheSameDepression)
    {
      Scene two = freezing(91800);
      two.alloy->solutes[0].liquidus_slope = 30;
      two.alloy->solutes.push_back({"sugar", 20});
      const double first = 0.1, second = (slope * bulk - 30 * first) / 20;
      two.initial.concentration = {Field::uniform(first), Field::uniform(second)};
      const RunRecord one = run(freezing(91800), 100), both = run(two, 100);
      expect_same(one, both, 1e-11);
      expect_closed(both);
      EXPECT_NEAR(both.solute[0].now, first * 1097 * 0.5, 1e-12);
      EXPECT_NEAR(both.solute[1].now, second * 1097 * 0.5, 1e-12);
    }

    TEST(AlloyFreezing, TwoSolutesThatDiffuseAlikeAreOne)
    {
      Scene one = freezing(91800), two = one;
      one.alloy->solutes[0].diffusivity = diffusivity;
      two.alloy->solutes = {{"first", slope}, {"second", slope}};
      for(Solute &solute : two.alloy->solutes)
        solute.diffusivity = diffusivity;
      two.initial.concentration
          = {Field::uniform(bulk / 4), Field::uniform(bulk * 3 / 4)};
      const RunRecord a = run(one, 60), b = run(two, 60);
      expect_same(a, b, 1e-8);
      expect_closed(b);
      for(std::size_t i = 0; i < a.temperature.size(); ++i)
        EXPECT_NEAR(a.concentration[0][i], b.concentration[0][i] + b.concentration[1][i],
                    1e-10);
    }

    TEST(AlloyFreezing, MeltsBack)
    {
      Scene scene = freezing(2e6);
      set_boundary(scene, Side::x_min,
                   varying_wall([](double time)
                                { return time < 13200 ? wall : start_temperature; }));
      for(const double d : {0., diffusivity})
      {
        scene.alloy->solutes[0].diffusivity = d;
        const RunRecord record = run(scene, 60, {{"steps", "2000"}});
        expect_closed(record);
        EXPECT_GT(*std::max_element(record.front.begin(), record.front.end()), 0.01);
        EXPECT_EQ(total_solid(record), 0);
        EXPECT_GT(*std::min_element(record.temperature.begin(), record.temperature.end()),
                  14.5);
        EXPECT_LE(*std::max_element(record.highest.begin(), record.highest.end()),
                  start_temperature + 1e-9);
      }
    }

    TEST(AlloyFreezing, BelowTheEutecticTemperatureAllFreezes)
    {
      const double length = 0.05, cold = -25;
      Scene scene = melt(length, start_temperature, 2e5);
      scene.alloy->eutectic_temperature = -18;
      set_boundary(scene, Side::x_min, fixed_wall(cold));
      const double removed
          = 1097 * length * (334400 + 4180 * start_temperature - 2006 * cold);
      for(const double d : {0., diffusivity})
      {
        scene.alloy->solutes[0].diffusivity = d;
        const RunRecord record = run(scene, 60);
        expect_closed(record);
        EXPECT_NEAR(total_solid(record), length, 1e-13);
        for(const double temperature : record.temperature)
          EXPECT_NEAR(temperature, cold, 1e-3);
        EXPECT_NEAR(record.heat.boundary, -removed, 1e-5 * removed);
        EXPECT_EQ(record.heat.latent, 0);
      }
    }

    TEST(AlloyFreezing, TheEutecticHoldsItsTemperature)
    {
      // A tenth of the heat that the rest gives off is taken away, slowly.
      const double left = slope * bulk / 18, heat = left * (334400 - (4180 - 2006) * 18.);
      Scene scene = melt(0.01, -17.999999, 1e7);
      scene.alloy->eutectic_temperature = -18;
      set_boundary(scene, Side::x_max, flux_wall(-0.1 * heat * 1097 * 0.01 / 1e7));
      const RunRecord record = run(scene, 8);
      expect_closed(record);
      EXPECT_NEAR(total_solid(record), 0.01 * (1 - 0.9 * left), 1e-8);
      for(const double temperature : record.temperature)
        EXPECT_NEAR(temperature, -18, 1e-4);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
