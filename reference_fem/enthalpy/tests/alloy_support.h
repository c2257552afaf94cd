#ifndef meltfront_reference_fem_enthalpy_tests_alloy_support_h
#define meltfront_reference_fem_enthalpy_tests_alloy_support_h

#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

namespace meltfront::reference_fem::tests
{
  using namespace cases;

  inline constexpr double start_temperature = 14.7, wall = -16.5, bulk = 0.14;
  inline constexpr double slope = 42.28, diffusivity = 6.8e-7 / 1097;

  /** Water with 14 % of sodium nitrate: Monaghan, Huppert and Worster (2005), section
   * 5; the heat of melting depends on the temperature. */
  inline Material solvent()
  {
    Material material;
    material.solid = {2.408, 2006, 1097};
    material.liquid = {0.498, 4180, 1097};
    material.latent_heat = 334400;
    return material;
  }

  /** An insulated slab at a uniform temperature. */
  inline Scene melt(double length, double temperature, double end,
                    double concentration = bulk)
  {
    Scene scene = slab(solvent(), length, temperature, 0, end);
    scene.alloy.emplace();
    scene.alloy->solutes.push_back({"sodium nitrate", slope});
    scene.alloy->crystal_density = 917;
    scene.initial.concentration = {Field::uniform(concentration)};
    return scene;
  }

  inline Field along_x(std::function<double(double)> value)
  {
    return {"along x", [value](const Position &p, double) { return value(p[0]); }, false};
  }

  inline void expect_closed(const RunRecord &record)
  {
    EXPECT_LE(record.worst_budget_defect(), 1e-12);
    EXPECT_LE(record.worst_solute_defect, 1e-13);
    EXPECT_EQ(record.mass.defect(), 0);
    EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
    EXPECT_EQ(record.cost.capped_steps, 0);
  }

  inline double total_solid(const RunRecord &record)
  {
    double sum = 0;
    for(std::size_t i = 0; i < record.weights.size(); ++i)
      sum += record.weights[i] * record.solid_fraction[i];
    return sum;
  }

  inline void expect_same(const RunRecord &a, const RunRecord &b, double tolerance)
  {
    ASSERT_EQ(a.temperature.size(), b.temperature.size());
    for(std::size_t i = 0; i < a.temperature.size(); ++i)
    {
      EXPECT_NEAR(a.temperature[i], b.temperature[i], tolerance);
      EXPECT_NEAR(a.solid_fraction[i], b.solid_fraction[i], tolerance);
    }
  }
} // namespace meltfront::reference_fem::tests

#endif
