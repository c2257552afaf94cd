// Run on any number of ranks: the meshes that they share, and the cycle on them.

#include <cases/tests/support/scenes.h>
#include <reference_fem/enthalpy/distributed/box_hierarchy.h>
#include <reference_fem/enthalpy/distributed/node_shares.h>
#include <reference_fem/enthalpy/distributed/rank_multigrid.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;
    using namespace test_support;

    /** A plane and a box in space, a wall of each of which prescribes temperatures. */
    std::vector<std::pair<Scene, int>> meshed_scenes()
    {
      std::vector<std::pair<Scene, int>> result;
      result.emplace_back(box(water(), 2, {0, -1, 0}, {3, 1, 0}, 3, 1), 96);
      result.emplace_back(box(water(), 3, {0, 0, 0}, {1, 0.5, 0.75}, 3, 1), 32);
      for(auto &[scene, n] : result)
        set_boundary(scene, Side::y_max, fixed_wall(-1));
      return result;
    }

    double sum_of_all(double own)
    {
      return dealii::Utilities::MPI::sum(own, MPI_COMM_WORLD);
    }

    double product(const std::vector<double> &a, const std::vector<double> &b,
                   std::size_t n_own)
    {
      double sum = 0;
      for(std::size_t i = 0; i < n_own; ++i)
        sum += a[i] * b[i];
      return sum_of_all(sum);
    }

    /** The same at a node whatever rank it is on. */
    double random_at(std::uint64_t number, unsigned int seed)
    {
      std::mt19937_64 random(7919 * number + seed);
      return std::uniform_real_distribution<double>(-1, 1)(random);
    }

    std::vector<double> random_field(const RankLevel &level, unsigned int seed)
    {
      std::vector<double> result;
      for(unsigned int i = 0; i < level.n_with_ghosts(); ++i)
        result.push_back(random_at(level.number(i), seed));
      return result;
    }

    double linear(const Position &p)
    {
      return 1 + 2 * p[0] - 3 * p[1] + 5 * p[2];
    }
  } // namespace

  TEST(RankLevel, EveryNodeIsOnOneRank)
  {
    for(const auto &[scene, n] : meshed_scenes())
      for(const RankLevel &level : make_rank_levels(scene, n, MPI_COMM_WORLD))
      {
        std::vector<double> times(level.lattice.n_nodes());
        for(unsigned int i = 0; i < level.n_own(); ++i)
        {
          times[level.number(i)] += 1;
          EXPECT_EQ(level.local(level.place(i)), i);
        }
        dealii::Utilities::MPI::sum(times, MPI_COMM_WORLD, times);
        EXPECT_EQ(times, std::vector<double>(times.size(), 1.));
      }
  }

  // Ranks differ by a block of a hundred or more, and by a side's nodes.
  TEST(RankLevel, SharesAreEven)
  {
    const auto n_ranks
        = static_cast<double>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
    BoxLattice lattice;
    lattice.cells = {512, 512, 0};
    lattice.upper = {1, 1, 0};
    const auto own = static_cast<double>(own_nodes(lattice, MPI_COMM_WORLD).n_elements());
    EXPECT_NEAR(own, static_cast<double>(lattice.n_nodes()) / n_ranks,
                0.02 * static_cast<double>(lattice.n_nodes()) / n_ranks);
  }

  TEST(RankLevel, GhostsGetTheValuesOfTheirRanks)
  {
    Traffic traffic;
    for(const auto &[scene, n] : meshed_scenes())
      for(const RankLevel &level : make_rank_levels(scene, n, MPI_COMM_WORLD))
      {
        std::vector<double> values = random_field(level, 1);
        std::fill(values.begin() + static_cast<std::ptrdiff_t>(level.n_own()),
                  values.end(), -7);
        level.exchange(values, traffic);
        EXPECT_EQ(values, random_field(level, 1));
      }
  }

  // K of linear elements with edges by the trapezoidal rule: exact for linear functions.
  TEST(RankLevel, ConductsAsTheMeshDoes)
  {
    for(const auto &[scene, n] : meshed_scenes())
      for(const RankLevel &level : make_rank_levels(scene, n, MPI_COMM_WORLD))
      {
        const BoxLattice &lattice = level.lattice;
        std::vector<double> u;
        for(unsigned int i = 0; i < level.n_with_ghosts(); ++i)
          u.push_back(linear(lattice.position(level.place(i))));
        const ConductionMatrix expanded = level.conduction.expanded();
        EXPECT_EQ(expanded.entries(), level.conduction.n_entries());
        level.conduction.multiply(
            u.data(),
            [&](std::size_t i, double sum)
            {
              const auto node = level.place(static_cast<unsigned int>(i));
              double out = 0; // through the sides
              const std::array<double, 3> slope{2, -3, 5};
              for(int d = 0; d < lattice.dimension; ++d)
                if(const bool lower = lattice.at_lower(node, d);
                   lower || lattice.at_upper(node, d))
                  out += (lower ? -1 : 1) * slope[d] * lattice.cell_volume()
                         / lattice.spacing(d) * lattice.share_of_cell(node, d);
              EXPECT_NEAR(level.conduction.diagonal[i] * u[i] - sum, out, 1e-11);
              EXPECT_NEAR(expanded.inflow(i, u), -out, 1e-11);
            });
      }
  }

  TEST(RankLevel, TransfersAreLinearAndEachOthersTransposes)
  {
    Traffic traffic;
    for(const auto &[scene, n] : meshed_scenes())
    {
      const std::vector<RankLevel> levels = make_rank_levels(scene, n, MPI_COMM_WORLD);
      ASSERT_GT(levels.size(), 2u);
      for(std::size_t l = 1; l < levels.size(); ++l)
      {
        const RankLevel &fine = levels[l - 1], &coarse = levels[l];
        std::vector<double> u;
        for(unsigned int i = 0; i < coarse.n_with_ghosts(); ++i)
          u.push_back(linear(coarse.lattice.position(coarse.place(i))));
        std::size_t rows = 0;
        coarse.to_finer.multiply(
            u.data(),
            [&](std::size_t i, double sum)
            {
              ++rows;
              const auto node = fine.place(static_cast<unsigned int>(i));
              EXPECT_NEAR(sum, linear(fine.lattice.position(node)), 1e-12);
            });
        EXPECT_EQ(rows, fine.n_own());
        const std::vector<double> of_coarse = random_field(coarse, 2),
                                  of_fine = random_field(fine, 3);
        std::vector<double> up(fine.n_own()), down(coarse.n_own());
        coarse.to_finer.multiply(of_coarse.data(),
                                 [&](std::size_t i, double sum) { up[i] = sum; });
        coarse.from_finer.multiply(of_fine.data(),
                                   [&](std::size_t i, double sum) { down[i] = sum; });
        EXPECT_NEAR(product(up, of_fine, fine.n_own()),
                    product(down, of_coarse, coarse.n_own()), 1e-10);
      }
    }
  }

  // What the sweeps leave out of the sums is zero, and what they leave is the residual.
  TEST(ConductionRuns, SweepFromZeroIsASweep)
  {
    for(const auto &[scene, n] : meshed_scenes())
      for(const RankLevel &level : make_rank_levels(scene, n, MPI_COMM_WORLD))
      {
        const ConductionRuns &conduction = level.conduction;
        const std::vector<double> b = random_field(level, 4);
        std::vector<double> inverse(level.n_own()), diagonal(level.n_own());
        for(std::size_t i = 0; i < level.n_own(); ++i)
          if(random_at(level.number(static_cast<unsigned int>(i)), 5) > -0.8)
          {
            diagonal[i] = 1.3 * conduction.diagonal[i];
            inverse[i] = 1 / diagonal[i];
          }
        std::vector<double> x(level.n_with_ghosts()), swept(x.size(), 1e300);
        conduction.sweep(true, b.data(), x.data(),
                         [&](std::size_t i, double sum) { return inverse[i] * sum; });
        conduction.sweep_from_zero(b.data(), inverse.data(), swept.data());
        for(std::size_t i = 0; i < level.n_own(); ++i)
          EXPECT_NEAR(swept[i], x[i], 1e-13);
        Traffic traffic;
        level.exchange(swept, traffic);
        std::vector<double> residual(level.n_own());
        conduction.residual_of_sweep(swept.data(), inverse.data(), residual.data());
        conduction.multiply(swept.data(),
                            [&](std::size_t i, double sum)
                            {
                              const double left = b[i] + sum - diagonal[i] * swept[i];
                              EXPECT_NEAR(residual[i], inverse[i] > 0 ? left : 0, 1e-11);
                            });
      }
  }

  // With a tenth of the nodes on the jump.
  TEST(RankMultigrid, CycleIsSymmetricAndConverges)
  {
    Traffic traffic;
    for(const auto &[scene, n] : meshed_scenes())
    {
      const std::vector<RankLevel> levels = make_rank_levels(scene, n, MPI_COMM_WORLD);
      const RankLevel &finest = levels.front();
      std::vector<char> active = finest.free;
      std::vector<double> capacity, residual(finest.n_own());
      for(unsigned int i = 0; i < finest.n_own(); ++i)
      {
        active[i] = active[i] && random_at(finest.number(i), 6) > -0.8;
        capacity.push_back(1e-3 * finest.conduction.diagonal[i]);
      }
      RankMultigrid multigrid(levels, traffic);
      multigrid.set_up({capacity, 1, active, residual, 0}, 1);
      const auto on_active = [&](unsigned int seed)
      {
        std::vector<double> field = random_field(finest, seed);
        for(std::size_t i = 0; i < field.size(); ++i)
          field[i] *= i < active.size() ? active[i] : 0;
        return field;
      };
      const std::vector<double> a = on_active(8), b = on_active(9);
      std::vector<double> cycle_a(finest.n_with_ghosts()), cycle_b(cycle_a.size());
      multigrid.precondition(a, cycle_a);
      multigrid.precondition(b, cycle_b);
      const double first = product(a, cycle_b, finest.n_own()),
                   second = product(b, cycle_a, finest.n_own()),
                   size = product(a, cycle_a, finest.n_own());
      EXPECT_NEAR(first, second, 1e-12 * size);
      EXPECT_GT(size, 0);
      // Ten cycles as an iteration of their own.
      std::vector<double> x(finest.n_with_ghosts()), left = a, image(finest.n_own());
      for(int k = 0; k < 10; ++k)
      {
        multigrid.precondition(left, cycle_a);
        for(std::size_t i = 0; i < finest.n_own(); ++i)
          x[i] += cycle_a[i];
        multigrid.multiply(x, image);
        for(std::size_t i = 0; i < finest.n_own(); ++i)
          left[i] = a[i] - image[i];
      }
      EXPECT_LT(std::sqrt(product(left, left, finest.n_own())),
                1e-3 * std::sqrt(product(a, a, finest.n_own())));
    }
  }
} // namespace meltfront::reference_fem::tests

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
