#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double pi = std::numbers::pi;
    using Formula = std::function<double(const Position &, double)>;

    /** A unit slab between cold walls that starts with a formula. */
    Scene cold_slab(const Formula &formula, double end)
    {
      Material material;
      material.latent_heat = 0;
      Scene scene = slab(material, 1, 0, 0, end);
      scene.initial.temperature = {"", formula};
      set_boundary(scene, Side::x_min, fixed_wall(0));
      set_boundary(scene, Side::x_max, fixed_wall(0));
      return scene;
    }

    double order(const Scene &scene, const Formula &formula)
    {
      const std::vector<int> cells{10, 20, 40, 80};
      std::vector<double> errors;
      for(const int n : cells)
      {
        const RunRecord record = run(scene, n, {{"steps", std::to_string(20 * n)}});
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        double largest = 0;
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
          largest = std::max(largest, std::abs(record.temperature[i]
                                               - formula({record.positions[0][i], 0, 0},
                                                         scene.end_time)));
        errors.push_back(largest);
      }
      EXPECT_LT(errors.back(), 1e-3);
      return fitted_order(cells, errors);
    }

    TEST(VolumetricSource, WarmsASlabToSecondOrder)
    {
      const Formula formula = [](const Position &p, double t)
      { return std::sin(pi * p[0]) * (1 - std::exp(-4 * t)); };
      Scene scene = cold_slab(formula, 0.5);
      scene.volumetric_source
          = Field{"", [](const Position &p, double t)
                  {
                    return std::sin(pi * p[0])
                           * (4 * std::exp(-4 * t) + pi * pi * (1 - std::exp(-4 * t)));
                  }};
      EXPECT_GT(order(scene, formula), 1.8);
      const RunRecord record = run(scene, 40);
      EXPECT_GT(record.heat.sources, 0.5);
      EXPECT_LT(record.heat.boundary, 0);
    }

    TEST(Inclusion, AJumpBetweenCellsIsOfSecondOrder)
    {
      const double a = 1.75658027885690253, b = 5.55479457412152502;
      const Formula formula = [=](const Position &p, double t)
      {
        return std::exp(-30.8557427606899345 * t)
               * (p[0] < 0.5 ? std::sin(a * p[0])
                             : 2.16073442764011616 * std::sin(b * (1 - p[0])));
      };
      Scene scene = cold_slab(formula, 0.05);
      scene.inclusion = cases::Inclusion{
          {"", [](const Position &p, double) { return p[0] - 0.5; }}, 10};
      EXPECT_GT(order(scene, formula), 1.7);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
