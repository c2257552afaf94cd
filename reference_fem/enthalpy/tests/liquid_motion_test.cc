#include <reference_fem/enthalpy/tests/support.h>

#include <cases/error.h>
#include <cases/exact/planar_neumann.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    Material with_densities(double solid, double liquid)
    {
      Material material;
      material.solid.density = solid;
      material.liquid.density = liquid;
      return material;
    }

    /** Neumann's solution with the motion of the liquid, from t = 0.02. */
    Scene freezing(const ExactPointer &exact, const Material &material)
    {
      Scene scene = slab(material, 1, 0, 0.02, 0.2);
      start_from(scene, exact);
      set_boundary(scene, Side::x_min, exact_wall(exact));
      set_boundary(scene, Side::x_max, exact_wall(exact));
      return scene;
    }

    TEST(LiquidMotion, FrontsConvergeToNeumannsSolution)
    {
      const std::vector<int> cells{40, 80, 160, 320};
      for(const double solid_density : {0.5, 0.917, 2.})
      {
        const Material material = with_densities(solid_density, 1);
        const auto exact = std::make_shared<const PlanarNeumann>(material, -0.5, 0.5);
        std::vector<double> errors;
        for(const int n : cells)
        {
          const RunRecord record = run(freezing(exact, material), n, {}, exact.get());
          EXPECT_LE(record.worst_budget_defect(), 1e-12);
          EXPECT_EQ(record.cost.capped_steps, 0);
          for(const double volume : record.volume)
            EXPECT_NEAR(volume, 1, 1e-12);
          errors.push_back(record.worst_front_error());
        }
        EXPECT_LT(errors.back(), 2e-3);
        EXPECT_GT(fitted_order(cells, errors), 1.2);
      }
    }

    /** What has come in by conduction and with the liquid is known exactly. */
    TEST(LiquidMotion, HeatThroughTheOpenEndIsTheWalls)
    {
      const Material material = with_densities(0.5, 1);
      const auto exact = std::make_shared<const PlanarNeumann>(material, -0.5, 0.5);
      const RunRecord record = run(freezing(exact, material), 320);
      const double gained
          = exact->heat_content(0, 1, 0.2) - exact->heat_content(0, 1, 0.02);
      EXPECT_NEAR(record.heat.boundary, gained, 2e-3 * std::abs(gained));
    }

    /** Liquid that is drawn in again as the solid melts. */
    TEST(LiquidMotion, GoesBothWays)
    {
      for(const double solid_density : {0.5, 2.})
      {
        const Scene scene
            = slab(with_densities(solid_density, 1), 1, 0.2, 2, fixed_wall(-1),
                   varying_wall([](double time)
                                { return time < 0.5 ? 0.2 : 3 * (time - 0.5) + 0.2; }));
        const RunRecord record = run(scene, 60);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        for(const double volume : record.volume)
          EXPECT_NEAR(volume, 1, 1e-12);
        EXPECT_GT(*std::max_element(record.solid.begin(), record.solid.end()),
                  1.1 * record.solid.back());
      }
    }

    void expect_refusal(const Scene &scene, const std::string &word,
                        const OptionTexts &options = {})
    {
      try
      {
        run(scene, 20, options);
        FAIL() << "not refused: " << word;
      }
      catch(const Refusal &refusal)
      {
        EXPECT_NE(std::string(refusal.what()).find(word), std::string::npos)
            << refusal.what();
      }
    }

    TEST(LiquidMotion, RefusesWhatItDoesNotMove)
    {
      const Material material = with_densities(0.5, 1);
      Scene scene = slab(material, 1, 0, 0, 1);
      scene.initial.temperature
          = field_of([](const Position &p) { return p[0] < 0.5 ? 1. : -1.; });
      expect_refusal(scene, "at the start there is solid elsewhere");
      expect_refusal(slab(material, 1, 0.1, 1, Boundary(), flux_wall(-3)),
                     "solid beyond liquid");
      expect_refusal(slab(material, 1, 0.1, 3, fixed_wall(-1), Boundary()), "too few");
      expect_refusal(slab(material, 1, 0.1, 1, fixed_wall(-1), Boundary()),
                     "no liquid is displaced", {{"front", "within_cells"}});
      expect_refusal(slab(material, 1, 0.1, 1, fixed_wall(-1), Boundary()),
                     "one dimension only", {{"dimension", "2"}});
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
