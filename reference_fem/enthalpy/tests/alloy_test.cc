#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double start_temperature = 14.7, wall = -16.5;

    /** Water with 14 % of sodium nitrate: Monaghan, Huppert and Worster (2005), section
     * 5; the heat of melting depends on the temperature. */
    Material solvent()
    {
      Material material;
      material.solid = {2.408, 2006, 1097};
      material.liquid = {0.498, 4180, 1097};
      material.latent_heat = 334400;
      return material;
    }

    Scene sodium_nitrate(double end, double diffusivity = 0)
    {
      Scene scene = slab(solvent(), 0.5, start_temperature, 0, end);
      scene.alloy.emplace();
      scene.alloy->solutes.push_back({"sodium nitrate", 42.28});
      scene.alloy->solutes[0].diffusivity = diffusivity;
      scene.alloy->crystal_density = 917;
      scene.initial.concentration = {Field::uniform(0.14)};
      set_boundary(scene, Side::x_min, fixed_wall(wall));
      return scene;
    }

    /** Temperature of the similarity solution without diffusion (integrated by others in
     * 40 digits). */
    struct Known
    {
      double x, temperature;
    };
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
      std::vector<double> errors;
      for(const int cells : n)
      {
        const RunRecord record = run(sodium_nitrate(91800), cells);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        EXPECT_LE(record.worst_solute_defect, 1e-13);
        EXPECT_EQ(record.cost.capped_steps, 0);
        errors.push_back(table_rms(record, late));
      }
      EXPECT_LE(errors[2], 8e-3);
      EXPECT_LE(errors[3], 2e-3);
      EXPECT_GE(fitted_order(n, errors), 1.5);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
