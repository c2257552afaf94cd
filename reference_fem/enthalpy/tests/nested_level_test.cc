#include <reference_fem/enthalpy/box_tree.h>
#include <reference_fem/enthalpy/linear_solver.h>
#include <reference_fem/enthalpy/refinable_mesh.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace meltfront::reference_fem
{
  namespace
  {
    using namespace tests;
    using cases::Side;

    /** Cells of a block, each of which is halved again and again by chance. */
    BoxTree random_tree(int dimension, std::uint32_t largest,
                        const std::array<std::uint32_t, 3> &blocks, std::mt19937 &random)
    {
      std::vector<BoxTree::Cell> cells, open;
      for(std::uint32_t z = 0; z < blocks[2]; ++z)
        for(std::uint32_t y = 0; y < blocks[1]; ++y)
          for(std::uint32_t x = 0; x < blocks[0]; ++x)
            open.push_back({{x * largest, y * largest, z * largest}, largest});
      while(!open.empty())
      {
        const BoxTree::Cell cell = open.back();
        open.pop_back();
        if(cell.size == 1 || std::uniform_real_distribution<>()(random) < 0.5)
        {
          cells.push_back(cell);
          continue;
        }
        for(unsigned int child = 0; child < 1u << dimension; ++child)
        {
          BoxTree::Cell half{cell.corner, cell.size / 2};
          for(int d = 0; d < dimension; ++d)
            half.corner[d] += (child >> d & 1u) * half.size;
          open.push_back(half);
        }
      }
      return {dimension, largest, std::move(cells)};
    }

    void expect_linear_functions_kept(BoxTree mesh)
    {
      const auto linear = [](const BoxTree::Place &place)
      { return 3. * place[0] - 2. * place[1] + 0.5 * place[2] + 7; };
      int levels = 1;
      for(; !mesh.is_coarsest(); ++levels)
      {
        const BoxTree coarser = mesh.coarser();
        EXPECT_LT(coarser.n_nodes(), mesh.n_nodes());
        const SparseRows shares = mesh.shares_of(coarser);
        ASSERT_EQ(shares.size(), mesh.n_nodes());
        for(std::size_t i = 0; i < shares.size(); ++i)
        {
          double value = 0, sum = 0;
          for(std::size_t k = shares.start[i]; k < shares.start[i + 1]; ++k)
          {
            value += shares.value[k] * linear(coarser.node(shares.column[k]));
            sum += shares.value[k];
          }
          EXPECT_EQ(sum, 1);
          EXPECT_NEAR(value, linear(mesh.node(i)), 1e-12);
        }
        mesh = coarser;
      }
      EXPECT_EQ(levels, 4);
    }

    /** Whatever the sizes of neighbours: cells eight times as large stand beside the
     * smallest ones. */
    TEST(BoxTree, CoarserMeshesKeepLinearFunctions)
    {
      std::mt19937 random(5);
      expect_linear_functions_kept(random_tree(2, 8, {5, 3, 1}, random));
      expect_linear_functions_kept(random_tree(3, 8, {2, 3, 2}, random));
    }

    /** P'A P by its rows equals that by products with unit vectors. */
    TEST(NestedMatrix, RestrictsByTheTripleProduct)
    {
      std::mt19937 random(9);
      std::uniform_real_distribution<> uniform;
      const cases::Scene scene = box(unit_material(), 2, {0, 0, 0}, {1, 0.75, 0}, 0.3, 1);
      const auto mesh = make_refinable_mesh(scene, 2, 64);
      std::vector<Wish> wishes(mesh->halvings_left().size(), Wish::keep);
      for(Wish &wish : wishes)
        wish = uniform(random) < 0.4 ? Wish::halve : Wish::keep;
      ASSERT_TRUE(mesh->adapt(wishes, {}));
      const Discretisation now = mesh->discretise();
      const std::vector<NestedLevel> levels = mesh->levels(now.conduction);
      const std::size_t n = levels[0].size(), coarse = levels[1].size();
      std::vector<char> mask(n);
      for(char &m : mask)
        m = uniform(random) < 0.8;
      const NestedMatrix fine(levels[0], now.conduction);
      NestedMatrix product(levels[1]);
      product.restrict_from(fine, now.conduction.diagonal, mask.data());
      std::vector<double> interpolated(n), image(n), restricted;
      for(std::size_t j = 0; j < coarse; ++j)
      {
        std::vector<double> unit(coarse), column(coarse);
        unit[j] = -1;
        product.subtract_product(product.diagonal, unit, column);
        interpolated.assign(n, 0);
        levels[0].add_interpolated(unit, mask.data(), interpolated);
        image.assign(n, 0);
        fine.subtract_product(fine.diagonal, interpolated, image);
        levels[0].restrict_to(image, mask.data(), restricted);
        for(std::size_t i = 0; i < coarse; ++i)
          EXPECT_NEAR(column[i], restricted[i], 1e-12);
      }
    }

    /** Finest along a circle, where nodes are inactive. */
    long iterations_with_a_front(int dimension, int n)
    {
      const cases::Scene scene
          = box(unit_material(), dimension, {0, 0, 0}, {1, 0.75, 0.5}, 0.3, 1);
      const auto refinable = make_refinable_mesh(scene, dimension, n);
      const auto from_circle = [](const cases::Position &p)
      { return std::abs(std::hypot(p[0] - 0.4, p[1] - 0.3, p[2]) - 0.25); };
      Discretisation mesh;
      std::vector<Wish> wishes;
      do
      {
        mesh = refinable->discretise();
        const std::size_t corners = std::size_t(1) << dimension;
        wishes.assign(mesh.cells.size() / corners, Wish::keep);
        for(std::size_t c = 0; c < wishes.size(); ++c)
        {
          cases::Position middle{};
          double size = 0;
          for(int d = 0; d < dimension; ++d)
          {
            const auto &x = mesh.site_positions[static_cast<std::size_t>(d)];
            const double low = x[mesh.cells[corners * c]],
                         high = x[mesh.cells[corners * c + corners - 1]];
            middle[d] = (low + high) / 2;
            size = high - low;
          }
          if(from_circle(middle) < 3 * size)
            wishes[c] = Wish::halve;
        }
      } while(refinable->adapt(wishes, {}));
      const std::size_t nodes = mesh.volume.size();
      std::vector<double> right(nodes), x(nodes);
      std::vector<char> active(nodes);
      for(std::size_t i = 0; i < nodes; ++i)
      {
        const cases::Position &p = mesh.positions[i];
        active[i] = p[0] > 0 && p[1] > 0 && from_circle(p) > 0.7 * mesh.spacing;
        right[i] = std::sin(40 * p[0]) + std::cos(7. * i);
      }
      const auto solver = make_multigrid_solver(
          mesh.conduction,
          std::make_shared<const Levels>(refinable->levels(mesh.conduction)));
      constexpr double long_step = 0.1;
      solver->solve({mesh.volume, long_step, active, right, 0}, 1e-12, x);
      double largest = 0;
      for(std::size_t i = 0; i < nodes; ++i)
        if(active[i])
          largest = std::max(largest, std::abs(mesh.volume[i] * x[i]
                                               + long_step * mesh.conduction.product(i, x)
                                               - right[i]));
        else
          EXPECT_EQ(x[i], 0);
      EXPECT_LT(largest, 1e-9);
      return solver->iterations();
    }

    TEST(MultigridSolver, IterationsDoNotGrowWithARefinedMesh)
    {
      for(const int n : {128, 256, 1024})
        EXPECT_LE(iterations_with_a_front(2, n), 20) << n;
      for(const int n : {32, 64})
        EXPECT_LE(iterations_with_a_front(3, n), 20) << n;
    }
  } // namespace
} // namespace meltfront::reference_fem
