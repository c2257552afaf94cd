#include <cases/effects.h>
#include <cases/error.h>
#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double inner = 0.05, outer = 0.5, pi = std::numbers::pi;

    /** A shell with Dirichlet walls. */
    Scene shell(int dimension)
    {
      Scene scene = ball(water(), dimension, outer, 10, 475000);
      scene.domain.shape = DomainShape::shell;
      scene.domain.inner_radius = inner;
      set_boundary(scene, Side::inner, fixed_wall(-10));
      set_boundary(scene, Side::outer, fixed_wall(10));
      return scene;
    }

    /** Around a line sink that lies outside the domain; walls and start are exact. */
    Scene around_line_sink(const ExactPointer &exact)
    {
      Scene scene = shell(2);
      scene.start_time = 47500;
      start_from(scene, exact);
      return scene;
    }

    double sum(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.);
    }

    double area(const Discretisation &mesh, Side side)
    {
      double result = 0;
      for(const WallNode &node : mesh.walls[static_cast<std::size_t>(side)])
        result += node.area;
      return result;
    }

    class ShellMesh : public testing::TestWithParam<int>
    {
    };

    TEST_P(ShellMesh, HasTheVolumeAndTheWallsOfTheShell)
    {
      const int d = GetParam();
      const auto ball_volume
          = [d](double r) { return d == 2 ? pi * r * r : 4. / 3. * pi * r * r * r; };
      const auto sphere = [d](double r) { return d == 2 ? 2 * pi * r : 4 * pi * r * r; };
      const double volume = ball_volume(outer) - ball_volume(inner);
      const Scene scene = shell(d);
      EXPECT_EQ(mesh_dimensions(scene), (std::vector{1, d}));
      for(const int dimension : {1, d})
      {
        const double tolerance = dimension == 1 ? 1e-13 : 1e-4;
        const Discretisation mesh = make_mesh(scene, dimension, 32)->discretise();
        EXPECT_NEAR(sum(mesh.volume), volume, tolerance * volume);
        EXPECT_NEAR(area(mesh, Side::outer), sphere(outer), tolerance * sphere(outer));
        EXPECT_NEAR(area(mesh, Side::inner), sphere(inner), tolerance * sphere(inner));
        EXPECT_NEAR(mesh.spacing, 1. / 32, 0.3 / 32);
        for(const Position &p : mesh.positions)
        {
          EXPECT_GE(coordinate(Symmetry::spherical, p), inner * (1 - 1e-14));
          EXPECT_LE(coordinate(Symmetry::spherical, p), outer * (1 + 1e-14));
        }
      }
    }

    INSTANTIATE_TEST_SUITE_P(Dimensions, ShellMesh, testing::Values(2, 3));

    TEST(Shell, ConvergesToTheExactFront)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      const Scene scene = around_line_sink(exact);
      const std::vector<int> n{64, 128, 256, 512};
      std::vector<double> errors;
      for(const int cells : n)
      {
        const RunRecord record = run(scene, cells, {}, exact.get());
        EXPECT_LE(record.worst_budget_defect(), 1e-13);
        EXPECT_EQ(record.cost.capped_steps, 0);
        errors.push_back(record.worst_front_error(scene.end_time / 2));
        RecordProperty("front_" + std::to_string(cells), std::to_string(errors.back()));
      }
      EXPECT_LE(errors.back(), 3e-4);
      EXPECT_GE(fitted_order(n, errors), 1.2);
    }

    TEST(Shell, RingsRepeatTheRadius)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      const Scene scene = around_line_sink(exact);
      const RunRecord radial = run(scene, 64, {}, exact.get());
      const RunRecord rings = run(scene, 64, {{"dimension", "2"}}, exact.get());
      EXPECT_LE(rings.worst_budget_defect(), 1e-13);
      EXPECT_EQ(rings.cost.capped_steps, 0);
      EXPECT_NEAR(rings.front.back(), radial.front.back(), 1e-3 * radial.front.back());
    }

    /** Solid at the melting temperature is known by the front alone; averages place it.
     */
    TEST(Shell, TheSceneSaysWhereItsFrontStarts)
    {
      const double front = 0.3137;
      Scene scene = shell(2);
      scene.initial.temperature = Field::uniform(0);
      scene.initial.front = Field{
          "", [=](const Position &p, double)
          { return std::pow(coordinate(Symmetry::cylindrical, p), 2) - front * front; }};
      set_boundary(scene, Side::inner, fixed_wall(0));
      scene.end_time = 1;
      EXPECT_NEAR(run(scene, 40).front.front(), front, 1e-12);
      EXPECT_NEAR(run(scene, 40, {{"dimension", "2"}}).front.front(), front,
                  1. / 40 / 16); // points in a cell: half their distance

      scene.initial.front.reset();
      EXPECT_NEAR(run(scene, 40).front.front(), inner, 1e-12);
    }

    TEST(Shell, UndercooledLiquidIsRefused)
    {
      NoObserver nobody;
      Scene scene = ball(Material{}, 2, 1, 0, 0.25);
      scene.material.melting_temperature = 0;
      const auto exact
          = std::make_shared<FrankGrowth>(scene.material, Symmetry::cylindrical, -0.3);
      scene.start_time = 0.04;
      set_boundary(scene, Side::outer, exact_wall(exact));
      start_from(scene, exact);
      scene.initial.front = Field{"", [exact](const Position &p, double time)
                                  { return exact->signed_distance(p, time); }};
      try
      {
        make_fem_enthalpy()->solve(scene, effects_called_for(scene), {}, nobody);
        FAIL();
      }
      catch(const Refusal &refusal)
      {
        EXPECT_NE(std::string(refusal.what()).find("metastable_phase"), std::string::npos)
            << refusal.what();
        EXPECT_NE(std::string(refusal.what()).find("undercooled"), std::string::npos)
            << refusal.what();
      }
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
