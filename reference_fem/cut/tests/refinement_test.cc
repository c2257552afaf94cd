#include <cases/error.h>
#include <reference_fem/cut/front_band.h>
#include <reference_fem/cut/heat_problem.h>
#include <reference_fem/cut/quadrature.h>
#include <reference_fem/cut/tests/cut_support.h>
#include <reference_fem/cut/transfer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    constexpr int cells = 64, refinement = 2;
    const BandWidths widths{5, 2};

    cases::Scene square()
    {
      return tests::box(tests::normalised_material(), 2, {-1, -1, 0}, {1, 1, 0}, 1, 1);
    }

    cases::Scene disk()
    {
      return tests::ball(tests::normalised_material(), 2, 1, 1, 1);
    }

    PointFunction circle(double radius)
    {
      return [radius](const Point &point) {
        return point.distance({0.031, -0.017}) - radius;
      };
    }

    /** A mesh that is finest about the zeros of a function. */
    std::shared_ptr<const BackgroundMesh>
    mesh_about(const cases::Scene &scene, const PointFunction &front, int degree = 1)
    {
      const BackgroundMesh base(scene, cells, degree, 2, refinement);
      return std::make_shared<const BackgroundMesh>(
          scene, cells, degree, 2, refinement,
          refined_about(points_of_front(base, front), base, widths));
    }

    State state_on(std::shared_ptr<const BackgroundMesh> mesh, const PointFunction &front,
                   HeatProblem &heat, const PointFunction &temperature)
    {
      State state{0, std::move(mesh), {}, {}, {}, {}, 0};
      heat.set_front(state, signed_distance_to_zeros(*state.mesh, front));
      heat.project(state, temperature);
      return state;
    }

    TEST(RefinedMesh, FillsTheBoxAndIsBalanced)
    {
      const auto mesh = mesh_about(square(), circle(0.6));
      double area = 0;
      std::set<long> sizes;
      for(unsigned int cell = 0; cell < mesh->cells.size(); ++cell)
      {
        const Cell &here = mesh->cells[cell];
        area += here.volume();
        sizes.insert(std::lround(here.width() / mesh->spacing));
        for(const Point &unit : {Point(0.5, 0.5), Point(0.01, 0.98), Point(0.99, 0.02)})
          EXPECT_EQ(mesh->cell_at(here.real(unit)), cell);
      }
      EXPECT_NEAR(area, 4, 1e-12);
      EXPECT_EQ(sizes, (std::set<long>{1, 2, 4}));
      EXPECT_DOUBLE_EQ(mesh->spacing, 2. / cells);
      EXPECT_LT(mesh->cells.size(), cells * cells / 2);
      for(const InnerFace &face : mesh->inner_faces)
      {
        const double ratio
            = mesh->cells[face.coarse].width() / mesh->cells[face.fine].width();
        EXPECT_TRUE(std::abs(ratio - 1) < 1e-9 || std::abs(ratio - 2) < 1e-9);
      }
    }

    /** No cell into which a phase reaches, nor a neighbour of one, hangs. */
    TEST(RefinedMesh, TheBandHoldsTheExtendedPhasesAfterAnyStep)
    {
      const auto mesh = mesh_about(square(), circle(0.6));
      const Values level_set = signed_distance_to_zeros(*mesh, circle(0.6));
      const CutGeometry geometry(*mesh, level_set);
      for(unsigned int cell = 0; cell < mesh->cells.size(); ++cell)
        for(const unsigned int dof : mesh->cells[cell].level_set_dofs)
        {
          const double distance = std::abs(circle(0.6)(mesh->level_set_positions[dof]));
          EXPECT_TRUE(mesh->finest(cell) || distance > 4.9 * mesh->spacing);
        }
      EXPECT_FALSE(leaves_band(*mesh, geometry, level_set, 3.5));
      const Values moved = signed_distance_to_zeros(*mesh, circle(0.6 + 0.07));
      EXPECT_TRUE(leaves_band(*mesh, CutGeometry(*mesh, moved), moved, 3.5));
    }

    TEST(RefinedMesh, RefusesCellsThatCannotBeDivided)
    {
      EXPECT_THROW(BackgroundMesh(square(), 30, 1, 2, 2), cases::Refusal);
      EXPECT_NO_THROW(BackgroundMesh(square(), 30, 1, 2, 1));
      const cases::Scene flat
          = tests::box(tests::normalised_material(), 2, {0, 0, 0}, {2, 1, 0}, 1, 1);
      EXPECT_THROW(BackgroundMesh(flat, 24, 1, 2, 3), cases::Refusal); // 12 rows
      EXPECT_NO_THROW(BackgroundMesh(flat, 32, 1, 2, 3));
    }

    double plane(const Point &point)
    {
      return 2 - 3 * point[0] + 0.7 * point[1];
    }

    /** A linear temperature solves the equations of both phases on hanging nodes, where a
     * straight front lets the quadratures be exact. */
    TEST(RefinedMesh, PatchTest)
    {
      const PointFunction front = [](const Point &point)
      { return (point[0] + 0.3 * point[1] - 0.117) / 1.044; };
      for(const int degree : {1, 2})
      {
        const auto mesh = mesh_about(square(), front, degree);
        const Values level_set = signed_distance_to_zeros(*mesh, front);
        const CutGeometry geometry(*mesh, level_set);
        const Stabilisation stabilisation;
        PhaseEquation equation;
        equation.conductivity = 2;
        equation.front_value = plane;
        equation.wall = [](const WallPoint &wall) -> WallCondition {
          return {true, plane(wall.position)};
        };
        for(const Phase phase : phases)
        {
          PhaseProblem problem(*mesh, geometry, level_set, phase, stabilisation);
          const Values solution = problem.solve(equation);
          for(std::size_t dof = 0; dof < solution.size(); ++dof)
            EXPECT_NEAR(solution[dof], plane(mesh->positions[dof]), 1e-10);
          const double flux = 2 * (-3 - 0.3 * -0.7) / std::hypot(1, 0.3);
          for(const double value : problem.front_flux(equation, solution))
            EXPECT_NEAR(value, phase == Phase::solid ? flux : -flux, 1e-8);
        }
      }
    }

    TEST(Transfer, ALinearFunctionIsExact)
    {
      for(const int degree : {1, 2})
      {
        const auto from = mesh_about(square(), circle(0.3), degree);
        const auto to = mesh_about(square(), circle(0.6), degree);
        const Transfer transfer(*from, *to);
        Values field, level_set;
        for(const Point &point : from->positions)
          field.push_back(plane(point));
        for(const Point &point : from->level_set_positions)
          level_set.push_back(plane(point));
        // All liquid.
        const CutGeometry geometry(*to, Values(to->level_set_positions.size(), 1.));
        const Values moved = transfer.temperature(field, geometry, Phase::liquid);
        for(std::size_t dof = 0; dof < moved.size(); ++dof)
          EXPECT_NEAR(moved[dof], plane(to->positions[dof]), 1e-13);
        const Values moved_level_set = transfer.level_set(level_set);
        for(std::size_t dof = 0; dof < moved_level_set.size(); ++dof)
          EXPECT_NEAR(moved_level_set[dof], plane(to->level_set_positions[dof]), 1e-13);
      }
    }

    double wavy(const Point &point)
    {
      const double distance = circle(0.45)(point);
      return 1 + distance * (2 + std::sin(9 * point[0]) * std::cos(7 * point[1]));
    }

    /** A front has moved by a cell and a half, three and a half from the edge of its
     * band, and the mesh follows: heat stays, the front and what lies about it does not
     * change at all. */
    TEST(Transfer, KeepsTheHeatOfEachPhaseAndTheFront)
    {
      for(const cases::Scene &scene : {square(), disk()})
        for(const int degree : {1, 2})
        {
          const Stabilisation stabilisation;
          HeatProblem heat(scene, 2. / cells, stabilisation, 0.25);
          const double moved = 1.5 * 2. / cells;
          const State before = state_on(mesh_about(scene, circle(0.45 - moved), degree),
                                        circle(0.45), heat, wavy);
          const State after
              = heat.transferred(before, mesh_about(scene, circle(0.45), degree));
          EXPECT_NE(before.mesh->cells.size(), after.mesh->cells.size());
          const double stored = heat.sensible_heat(before);
          EXPECT_NEAR(heat.sensible_heat(after), stored, 1e-12 * std::abs(stored));
          EXPECT_NEAR(heat.latent_heat(after), heat.latent_heat(before), 1e-13);
          ASSERT_EQ(before.geometry->cut_cells.size(), after.geometry->cut_cells.size());
          for(const CutCell &cut : after.geometry->cut_cells)
          {
            const Cell &now = after.mesh->cells[cut.cell];
            const Cell &then
                = before.mesh->cells[before.mesh->cell_at(now.real({0.5, 0.5}))];
            for(unsigned int i = 0; i < now.dofs.size(); ++i)
              for(const Values *pair : {&before.unknown[0], &before.unknown[1]})
                EXPECT_EQ((*pair)[then.dofs[i]],
                          after.unknown[pair - before.unknown.data()][now.dofs[i]]);
            for(unsigned int i = 0; i < now.level_set_dofs.size(); ++i)
            {
              EXPECT_EQ(before.level_set[then.level_set_dofs[i]],
                        after.level_set[now.level_set_dofs[i]]);
              EXPECT_EQ(before.speed.values[then.level_set_dofs[i]],
                        after.speed.values[now.level_set_dofs[i]]);
              EXPECT_TRUE(after.speed.band[now.level_set_dofs[i]]);
            }
          }
        }
    }

    /** Integral of ln r over the square of side 2 a around its origin, in polar
     * coordinates. */
    double logarithm_over_square(double a)
    {
      constexpr int pieces = 2000;
      double sum = 0;
      for(int i = 0; i < pieces; ++i)
      {
        const double width = std::numbers::pi / 4 / pieces;
        const double reach = a / std::cos((i + 0.5) * width);
        sum += 8 * width * reach * reach / 2 * (std::log(reach) - 0.5);
      }
      return sum;
    }

    TEST(SinkField, IntegralAcrossTheSource)
    {
      cases::Scene scene = square();
      scene.sources.push_back(
          tests::steady_sink({0.25, -0.125, 0}, 2 * std::numbers::pi));
      const SinkField field(scene, 1e-9);
      constexpr double a = 0.2, side = 2;
      const double whole = field.integral({0.25 - a, -0.125 - a}, Point(2 * a, 2 * a), 0);
      EXPECT_NEAR(whole, logarithm_over_square(a) - 4 * a * a * std::log(side), 1e-8);
      // Parts, also with the source on their edges, make up the whole.
      double parts = 0;
      for(const double x : {0.25 - a, 0.25})
        for(const double y : {-0.125 - a, -0.125})
          parts += field.integral({x, y}, Point(a, a), 0);
      EXPECT_NEAR(parts, whole, 1e-15);
      const Cell far{{-0.7, 0.3}, Point(0.1, 0.1), {}, {}};
      double sum = 0;
      for(const VolumePoint &point : whole_cell(far, 6))
        sum += point.weight * field.value(far.real(point.unit), 0);
      EXPECT_NEAR(field.integral(far.lower, far.size, 0), sum, 1e-14);
    }

    class RefinedRuns : public testing::Test
    {
    protected:
      const std::shared_ptr<const cases::LineSink> exact
          = std::make_shared<cases::LineSink>(tests::water(), 0.15, 10);
    };

    TEST_F(RefinedRuns, AsGoodAsAUniformMeshOfTheSameFinestCells)
    {
      const cases::Scene scene = tests::sink_in_disk(exact);
      const tests::Course uniform = tests::run_cut(scene, 64, {{"refinement", "0"}});
      const tests::Course refined = tests::run_cut(scene, 64, {{"refinement", "1"}});
      EXPECT_LE(tests::front_error(refined, *exact), 2e-4);
      EXPECT_NEAR(refined.solid.back(), uniform.solid.back(),
                  2e-4 * uniform.solid.back());
      EXPECT_TRUE(tests::grows(refined));
      EXPECT_EQ(refined.cost.capped_steps, 0);
      EXPECT_LT(refined.cost.unknowns, 0.7 * uniform.cost.unknowns);
      EXPECT_LT(refined.cost.work, 0.8 * uniform.cost.work);
    }

    TEST_F(RefinedRuns, AnUnknownNumberOfDivisionsIsRefused)
    {
      const cases::Scene scene = tests::sink_in_disk(exact);
      EXPECT_THROW(tests::run_cut(scene, 30, {{"refinement", "2"}}), cases::Refusal);
      EXPECT_THROW(tests::run_cut(scene, 32, {{"refinement", "7"}}), cases::InputError);
      EXPECT_THROW(tests::run_cut(scene, 32, {{"refinement", "-1"}}), cases::InputError);
    }
  } // namespace
} // namespace meltfront::reference_fem::cut
