#include <reference_fem/enthalpy/tests/support.h>

#include <cases/error.h>
#include <cases/exact/planar_neumann.h>

#include <gtest/gtest.h>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    const OptionTexts at_nodes{{"steps_per_cell", "4"}};
    const OptionTexts within_cells{{"steps_per_cell", "4"}, {"front", "within_cells"}};

    double error(const ExactPointer &exact, const Material &material, int n,
                 const OptionTexts &options)
    {
      Scene scene = slab(material, 1, 0, 0.01, 0.25);
      start_from(scene, exact);
      set_boundary(scene, Side::x_min, exact_wall(exact));
      set_boundary(scene, Side::x_max, exact_wall(exact));
      const RunRecord record = run(scene, n, options, exact.get());
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
      EXPECT_TRUE(record.obeys_maximum_principle);
      EXPECT_EQ(record.cost.capped_steps, 0);
      return record.worst_front_error(0.1);
    }

    TEST(FrontConduction, WithinCellsFrontsAreLessThanHalfAsFarOff)
    {
      Material material;
      material.liquid.conductivity = 0.5;
      const auto exact = std::make_shared<const PlanarNeumann>(material, -1, 0.3);
      std::vector<double> errors;
      const std::vector<int> cells{40, 80, 160};
      for(const int n : cells)
      {
        errors.push_back(error(exact, material, n, within_cells));
        EXPECT_LT(2 * errors.back(), error(exact, material, n, at_nodes));
      }
      EXPECT_GT(fitted_order(cells, errors), 1.4);
    }

    TEST(FrontConduction, IsForLinesOnly)
    {
      const Scene scene = box(unit_material(), 2, {0, 0, 0}, {1, 1, 0}, 0, 1);
      EXPECT_THROW(run(scene, 8, within_cells), Refusal);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
