#include <cases/exact/planar_neumann.h>
#include <reference_fem/fitted/tests/support.h>

#include <gtest/gtest.h>

#include <cstdio>

namespace meltfront::reference_fem::fitted::tests
{
  namespace
  {
    using namespace reference_fem::tests;
    using namespace cases;

    TEST(FemFitted, PlaneFreezing)
    {
      const auto exact = std::make_shared<PlanarNeumann>(normalised_material(),
                                                         normalised_wall, normalised_far);
      Scene scene = slab(normalised_material(), 1, normalised_far, 0.01, 0.25);
      set_boundary(scene, Side::x_min, exact_wall(exact));
      set_boundary(scene, Side::x_max, exact_wall(exact));
      start_from(scene, exact);
      for(const int n : {4, 8, 16, 32})
      {
        const Record record = run(scene, n, {}, exact.get());
        std::printf("n %d end %.2e worst %.2e T %.2e budget %.1e its %ld most %ld steps "
                    "%ld wall %.3f unknowns %ld\n",
                    n, record.final_front_error(), record.worst_front_error(),
                    record.temperature_error, record.worst_budget_defect(),
                    record.cost.solver_iterations, record.cost.most_iterations,
                    record.cost.steps, record.cost.stepping_wall, record.cost.unknowns);
      }
    }
  } // namespace
} // namespace meltfront::reference_fem::fitted::tests
