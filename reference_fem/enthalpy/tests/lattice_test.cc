#include <reference_fem/enthalpy/linear_solver.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    using namespace tests;
    using cases::Side;

    cases::Scene cold_box(int dimension, double end)
    {
      cases::Scene scene
          = box(unit_material(), dimension, {0, 0, 0}, {1, 0.75, 0.5}, 0.3, end);
      set_boundary(scene, Side::x_min, fixed_wall(-1));
      set_boundary(scene, Side::y_min, fixed_wall(-1));
      return scene;
    }

    TEST(Lattice, NodesAreNumberedAlongXFirst)
    {
      cases::Scene scene = cold_box(3, 1);
      set_boundary(scene, Side::z_min, periodic_wall());
      set_boundary(scene, Side::z_max, periodic_wall());
      const Discretisation mesh = make_mesh(scene, 3, 8)->discretise();
      ASSERT_TRUE(mesh.lattice);
      EXPECT_EQ(mesh.lattice->nodes, (std::array<unsigned int, 3>{9, 7, 4}));
      ASSERT_EQ(mesh.volume.size(), mesh.lattice->size());
      for(std::size_t i = 0; i < mesh.volume.size(); ++i)
      {
        EXPECT_NEAR(mesh.positions[i][0], (i % 9) / 8., 1e-14);
        EXPECT_NEAR(mesh.positions[i][1], (i / 9 % 7) / 8., 1e-14);
        EXPECT_NEAR(mesh.positions[i][2], (i / 63) / 8., 1e-14);
      }
    }

    /** Interpolation is exact for linear functions, restriction is its adjoint. */
    TEST(Lattice, InterpolatesLinearlyAndRestrictsByTheAdjoint)
    {
      for(const unsigned int n : {4u, 5u, 11u, 12u})
      {
        const Lattice lattice{{n, n + 1, 6}, {}};
        const std::vector<LatticeLevel> levels = lattice_levels(lattice);
        const LatticeLevel &level = levels.front();
        std::vector<double> coarse(level.coarse_size()), fine(level.size()), back;
        for(std::size_t i = 0; i < coarse.size(); ++i)
          coarse[i] = std::sin(1. + i);
        level.add_interpolated(coarse, nullptr, fine);
        std::vector<double> other(level.size());
        for(std::size_t i = 0; i < other.size(); ++i)
          other[i] = std::cos(3. * i);
        level.restrict_to(other, nullptr, back);
        double on_fine = 0, on_coarse = 0;
        for(std::size_t i = 0; i < fine.size(); ++i)
          on_fine += fine[i] * other[i];
        for(std::size_t i = 0; i < coarse.size(); ++i)
          on_coarse += coarse[i] * back[i];
        EXPECT_NEAR(on_fine, on_coarse, 1e-12);

        const auto position_of_coarse = [](unsigned int i, unsigned int nodes)
        { return std::min(2 * i, nodes - 1); };
        const auto nx = static_cast<unsigned int>(level.line[0].coarse_nodes());
        const auto ny = static_cast<unsigned int>(level.line[1].coarse_nodes());
        for(unsigned int i = 0; i < coarse.size(); ++i)
          coarse[i] = position_of_coarse(i % nx, n)
                      + 3. * position_of_coarse(i / nx % ny, n + 1)
                      - 2. * position_of_coarse(i / nx / ny, 6);
        std::fill(fine.begin(), fine.end(), 0);
        level.add_interpolated(coarse, nullptr, fine);
        for(unsigned int i = 0; i < fine.size(); ++i)
          EXPECT_NEAR(fine[i], i % n + 3. * (i / n % (n + 1)) - 2. * (i / n / (n + 1)),
                      1e-12);
      }
    }

    /** The system of a long step on a box of which a disk melts: inactive nodes. */
    long iterations_with_a_front(int dimension, int n)
    {
      const cases::Scene scene = cold_box(dimension, 1);
      const Discretisation mesh = make_mesh(scene, dimension, n)->discretise();
      const std::size_t nodes = mesh.volume.size();
      std::vector<double> right(nodes), x(nodes);
      std::vector<char> active(nodes);
      for(std::size_t i = 0; i < nodes; ++i)
      {
        const auto [a, b, c] = mesh.positions[i];
        const double r = std::hypot(a - 0.4, b - 0.3, c);
        active[i] = a > 0 && b > 0 && std::abs(r - 0.25) > 0.7 * mesh.spacing;
        right[i] = std::sin(40 * a) + std::cos(7. * i);
      }
      const auto solver = make_multigrid_solver(
          mesh.conduction, std::make_shared<const Levels>(lattice_levels(*mesh.lattice)));
      constexpr double long_step = 0.1;
      solver->solve({mesh.volume, long_step, active, right, 0}, 1e-12, x);
      double largest = 0, scale = 0;
      for(std::size_t i = 0; i < nodes; ++i)
        if(active[i])
        {
          largest = std::max(largest, std::abs(mesh.volume[i] * x[i]
                                               + long_step * mesh.conduction.product(i, x)
                                               - right[i]));
          scale = std::max(scale, std::abs(right[i]));
        }
        else
          EXPECT_EQ(x[i], 0);
      EXPECT_LT(largest, 1e-10 * scale);
      return solver->iterations();
    }

    TEST(LatticeSolver, IterationsDoNotGrowWithTheLattice)
    {
      for(const int n : {64, 100, 256})
        EXPECT_LE(iterations_with_a_front(2, n), 15) << n;
      for(const int n : {24, 40})
        EXPECT_LE(iterations_with_a_front(3, n), 15) << n;
      // On few nodes sweeps do.
      EXPECT_LE(iterations_with_a_front(2, 16), 40);
    }

    TEST(KrylovSolver, KeepsItsHierarchyOverStepsEqualUpToRounding)
    {
      const Discretisation mesh = make_mesh(cold_box(2, 1), 2, 32)->discretise();
      const std::size_t nodes = mesh.volume.size();
      std::vector<double> right(nodes, 1), x(nodes);
      const std::vector<char> active(nodes, 1);
      const auto solver = make_krylov_solver(mesh.conduction, Preconditioner::amg);
      const auto work_of = [&](double step)
      {
        const long before = solver->work();
        solver->solve({mesh.volume, step, active, right, 0}, 1e-10, x);
        return solver->work() - before;
      };
      const long first = work_of(0.1);
      EXPECT_LT(work_of(0.1 * (1 + 1e-15)), first);
      EXPECT_LT(work_of(0.1 * (1 - 3e-15)), first);
      EXPECT_GE(work_of(0.2), first);
    }

    /** Some hundred cells in the first steps, no fewer than ten in the last ones. */
    TEST(LongSteps, FrontsCrossManyCellsWithoutACappedIteration)
    {
      for(const double latent : {0.02, 1., 50.})
        for(const double conductivity : {0.01, 1., 100.})
        {
          cases::Material material = unit_material();
          material.latent_heat = latent;
          material.liquid.conductivity = conductivity;
          const cases::Scene scene
              = slab(material, 1, 0.3, 0.1, fixed_wall(-1), cases::Boundary());
          const RunRecord record
              = run(scene, 1024, {{"steps", "10"}, {"start_halvings", "0"}});
          EXPECT_EQ(record.statistics.halvings, 0) << latent << ' ' << conductivity;
          EXPECT_LE(record.statistics.iterations, 30) << latent << ' ' << conductivity;
          EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
        }
      const RunRecord corner
          = run(cold_box(2, 0.1), 160, {{"steps", "6"}, {"start_halvings", "0"}});
      EXPECT_EQ(corner.statistics.halvings, 0);
      EXPECT_LE(corner.statistics.iterations, 20);
    }
  } // namespace
} // namespace meltfront::reference_fem
