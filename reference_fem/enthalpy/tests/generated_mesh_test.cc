// Bodies that deal.II's generators make, held against an exact solution that fits any
// body.

#include <cases/case_file/generated_mesh.h>
#include <cases/exact/line_sink.h>
#include <cases/tests/support/meshes.h>
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

    /** Ice that grows around a line sink at the origin, in a body whose walls are exact.
     */
    Scene ice_in(const std::string &generator, const std::string &arguments, int halvings,
                 const std::shared_ptr<const LineSink> &exact)
    {
      Scene scene = box(water(), 2, {}, {1, 1, 0}, 10, 475000);
      const auto &known = *std::ranges::find(mesh_generators(), generator,
                                             [](const MeshGenerator &each)
                                             { return std::string(each.name); });
      test_support::take_mesh(scene, generate_mesh(known, 2, arguments, halvings).cells);
      for(const Side side : scene.sides())
        set_boundary(scene, side, exact_wall(exact));
      return scene;
    }

    /** Of the radius of a disk of the ice's area, that in a hole included, over the
     * second half of the run and the front's last place. */
    double worst_front_error(const RunRecord &record, const LineSink &exact, double hole)
    {
      double worst = 0;
      for(std::size_t k = 0; k < record.time.size(); ++k)
        if(record.time[k] >= record.time.back() / 2)
          worst = std::max(worst, std::abs(std::sqrt((record.solid[k] + hole) / pi)
                                           - exact.front(record.time[k])));
      return worst / exact.front(record.time.back());
    }

    double front_error(const Scene &scene, int n, const LineSink &exact, double hole)
    {
      const RunRecord record = run(scene, n, {}, &exact);
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
      EXPECT_EQ(record.cost.capped_steps, 0);
      return worst_front_error(record, exact, hole);
    }

    TEST(GeneratedMesh, FrontsConvergeInAnAngle)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      Scene scene = ice_in("hyper_L", "-0.4 : 1.2 : false", 0, exact);
      scene.sources.push_back(steady_sink({}, exact->strength()));
      const std::vector<int> levels{8, 16, 32, 64};
      std::vector<double> errors;
      for(const int n : levels)
        errors.push_back(front_error(scene, n, *exact, 0));
      EXPECT_GE(fitted_order(levels, errors), 1);
      EXPECT_LE(errors.back(), 0.01);
    }

    /** A ring about the sink: the start is exact, and the sink is the inner wall. */
    Scene ring(int halvings, const std::shared_ptr<const LineSink> &exact)
    {
      Scene scene
          = ice_in("hyper_shell", "0, 0 : 0.05 : 0.4 : 12 : true", halvings, exact);
      scene.start_time = 47500;
      const std::shared_ptr<const ExactSolution> start = exact;
      scene.initial.temperature
          = field_of([start, time = scene.start_time](const Position &p)
                     { return start->temperature(p, time); });
      return scene;
    }

    double hole_of_ring(int halvings)
    {
      const double sides = 12 * std::exp2(halvings);
      return sides / 2 * std::sin(2 * pi / sides) * 0.05 * 0.05;
    }

    // Whatever polygon stands for the ring, halved cells lead to its own solution.
    TEST(GeneratedMesh, FrontsConvergeInAPolygonalRing)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      const std::vector<int> levels{2, 4, 8, 16};
      std::vector<double> errors;
      for(const int n : levels)
        errors.push_back(front_error(ring(1, exact), n, *exact, hole_of_ring(1)));
      EXPECT_GE(fitted_order(levels, errors), 1);
      EXPECT_LE(errors.back(), 0.01);
    }

    TEST(GeneratedMesh, FrontsConvergeAsTheRingGetsRound)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      const std::vector<int> levels{2, 4, 8, 16};
      std::vector<double> errors;
      for(int halvings = 2; halvings <= 5; ++halvings)
        errors.push_back(
            front_error(ring(halvings, exact), 1, *exact, hole_of_ring(halvings)));
      EXPECT_GE(fitted_order(levels, errors), 1);
      EXPECT_LE(errors.back(), 0.01);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
