#include <cases/error.h>
#include <reference_fem/enthalpy/refinable_mesh.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace meltfront::reference_fem
{
  namespace
  {
    using namespace tests;
    using cases::Position;
    using cases::Side;

    cases::Scene domain_of(int dimension, const Position &upper = {1, 0.75, 0.5})
    {
      cases::Scene scene = box(unit_material(), dimension, {0, 0, 0}, upper, 0.3, 1);
      set_boundary(scene, Side::x_min, fixed_wall(-1));
      set_boundary(scene, Side::y_max, flux_wall(1));
      return scene;
    }

    cases::Scene half_section()
    {
      cases::Scene scene = domain_of(2, {1, 0.5, 0});
      scene.domain.shape = cases::DomainShape::axisymmetric;
      return scene;
    }

    double sum_of(const std::vector<double> &values)
    {
      long double sum = 0;
      for(const double value : values)
        sum += value;
      return static_cast<double>(sum);
    }

    double held(const Discretisation &mesh, const std::vector<double> &field)
    {
      long double sum = 0;
      for(std::size_t i = 0; i < field.size(); ++i)
        sum += static_cast<long double>(mesh.volume[i]) * field[i];
      return static_cast<double>(sum);
    }

    void halve_all(RefinableMesh &mesh)
    {
      std::vector<Wish> wishes;
      do
        wishes.assign(mesh.halvings_left().size(), Wish::halve);
      while(mesh.adapt(wishes, {}));
    }

    /** Joins nearly all cells or halves some of them, in turn. */
    std::vector<Wish> random_wishes(const RefinableMesh &mesh, int round,
                                    std::mt19937 &random)
    {
      std::vector<Wish> wishes(mesh.halvings_left().size());
      for(Wish &wish : wishes)
      {
        const double chance = std::uniform_real_distribution<>()(random);
        wish = round % 2 == 0 ? (chance < 0.3 ? Wish::halve : Wish::keep)
               : chance < 0.9 ? Wish::join
                              : Wish::halve;
      }
      return wishes;
    }

    void expect_same_lattice(const cases::Scene &scene, int dimension, int n)
    {
      const Discretisation lattice = make_mesh(scene, dimension, n)->discretise();
      const auto refinable = make_refinable_mesh(scene, dimension, n);
      halve_all(*refinable);
      const Discretisation mesh = refinable->discretise();
      EXPECT_EQ(mesh.spacing, lattice.spacing);
      EXPECT_TRUE(mesh.hanging.empty());
      EXPECT_EQ(mesh.conduction.row_start, lattice.conduction.row_start);
      EXPECT_EQ(mesh.conduction.column, lattice.conduction.column);
      ASSERT_EQ(mesh.volume.size(), lattice.volume.size());
      const double scale = *std::ranges::max_element(lattice.conduction.conductance);
      for(std::size_t k = 0; k < lattice.conduction.conductance.size(); ++k)
        EXPECT_NEAR(mesh.conduction.conductance[k], lattice.conduction.conductance[k],
                    1e-12 * scale);
      for(std::size_t i = 0; i < mesh.volume.size(); ++i)
        EXPECT_NEAR(mesh.volume[i], lattice.volume[i], 1e-12 * lattice.volume[i]);
      for(std::size_t side = 0; side < cases::n_sides; ++side)
      {
        ASSERT_EQ(mesh.walls[side].size(), lattice.walls[side].size());
        for(std::size_t i = 0; i < mesh.walls[side].size(); ++i)
        {
          EXPECT_EQ(mesh.walls[side][i].node, lattice.walls[side][i].node);
          EXPECT_NEAR(mesh.walls[side][i].area, lattice.walls[side][i].area, 1e-12);
        }
      }
    }

    TEST(RefinableMesh, HalvedThroughoutIsTheLattice)
    {
      expect_same_lattice(domain_of(2), 2, 32);
      expect_same_lattice(domain_of(2, {1, 0.7, 0}), 2, 40);
      expect_same_lattice(domain_of(3), 3, 16);
      expect_same_lattice(half_section(), 2, 32);
    }

    /** Symmetric to the bit, no conductance negative, and no flow into a node that is
     * inside where the values are linear. */
    void expect_sound_network(const cases::Scene &scene, const Discretisation &mesh,
                              bool linear_in_x)
    {
      const ConductionMatrix &network = mesh.conduction;
      EXPECT_TRUE(network.is_monotone());
      const auto value = [&](std::size_t i)
      {
        const auto [x, y, z] = mesh.positions[i];
        return (linear_in_x ? 0.7 * x : 0) - 1.3 * y + 0.4 * z + 2;
      };
      std::vector<double> linear(mesh.volume.size());
      for(std::size_t i = 0; i < linear.size(); ++i)
        linear[i] = value(i);
      for(std::size_t i = 0; i < network.size(); ++i)
      {
        double of_row = 0;
        for(std::size_t k = network.row_start[i]; k < network.row_start[i + 1]; ++k)
        {
          const std::size_t j = network.column[k];
          const auto first = network.column.begin() + network.row_start[j],
                     last = network.column.begin() + network.row_start[j + 1];
          const auto back = std::lower_bound(first, last, i);
          ASSERT_TRUE(back != last && *back == i);
          EXPECT_EQ(network.conductance[k],
                    network.conductance[back - network.column.begin()]);
          of_row += network.conductance[k];
        }
        EXPECT_EQ(of_row, network.diagonal[i]);
        bool inside = true;
        for(int d = 0; d < mesh.dimension; ++d)
          inside &= mesh.positions[i][d] > scene.domain.lower[d] + 1e-9
                    && mesh.positions[i][d] < scene.domain.upper[d] - 1e-9;
        const double flow = inside ? network.inflow(i, linear) : 0;
        EXPECT_NEAR(flow, 0, 1e-12 * network.diagonal[i]);
      }
    }

    void expect_sound_sites(const Discretisation &mesh)
    {
      EXPECT_NEAR(sum_of(mesh.site_weights), sum_of(mesh.volume), 1e-12);
      for(const HangingSite &hangs : mesh.hanging)
      {
        EXPECT_EQ(mesh.site_weights[hangs.site], 0);
        double sum = 0;
        Position place{};
        for(const auto &[node, share] : hangs.nodes)
        {
          sum += share;
          for(int d = 0; d < 3; ++d)
            place[d] += share * mesh.positions[node][d];
        }
        EXPECT_EQ(sum, 1);
        for(int d = 0; d < mesh.dimension; ++d)
          EXPECT_NEAR(place[d], mesh.site_positions[d][hangs.site], 1e-14);
      }
    }

    void expect_sound_random_meshes(const cases::Scene &scene, int dimension, int n,
                                    double volume, bool linear_in_x = true)
    {
      const auto mesh = make_refinable_mesh(scene, dimension, n);
      std::mt19937 random(7);
      std::size_t hanging = 0;
      for(int round = 0; round < 8; ++round)
      {
        mesh->adapt(random_wishes(*mesh, round, random), {});
        const Discretisation now = mesh->discretise();
        hanging += now.hanging.size();
        EXPECT_GT(*std::ranges::min_element(now.volume), 0);
        EXPECT_NEAR(sum_of(now.volume), volume, 1e-13);
        double area = 0;
        for(const WallNode &node : now.walls[std::size_t(Side::x_min)])
          area += node.area;
        EXPECT_NEAR(area, !linear_in_x ? 0 : dimension == 2 ? 0.75 : 0.375, 1e-13);
        expect_sound_network(scene, now, linear_in_x);
        expect_sound_sites(now);
      }
      EXPECT_GT(hanging, 100);
    }

    TEST(RefinableMesh, HangingNodesLeaveASoundNetwork)
    {
      expect_sound_random_meshes(domain_of(2), 2, 64, 0.75);
      expect_sound_random_meshes(domain_of(3), 3, 64, 0.375);
    }

    /** About an axis linear functions of the height alone are harmonic. */
    TEST(RefinableMesh, HangingNodesLeaveASoundNetworkAboutAnAxis)
    {
      expect_sound_random_meshes(half_section(), 2, 64, 0.5 * std::numbers::pi, false);
    }

    struct Carried
    {
      double worst_change = 0; ///< of what a field holds, relative
      int changes = 0;
    };

    Carried carry_over_random_meshes(const cases::Scene &scene, int dimension, int n,
                                     int rounds)
    {
      const auto mesh = make_refinable_mesh(scene, dimension, n);
      std::mt19937 random(11);
      Discretisation now = mesh->discretise();
      std::vector<double> one(now.volume.size(), 1.7), some(now.volume.size());
      for(double &value : some)
        value = std::uniform_real_distribution<>(-1, 2)(random);
      Carried result;
      for(int round = 0; round < rounds; ++round)
      {
        const double before = held(now, some);
        const auto [least, largest] = std::ranges::minmax(some);
        if(!mesh->adapt(random_wishes(*mesh, round, random), {&one, &some}))
          continue;
        ++result.changes;
        now = mesh->discretise();
        EXPECT_EQ(some.size(), now.volume.size());
        result.worst_change = std::max(
            result.worst_change, std::abs(held(now, some) - before) / sum_of(now.volume));
        const auto [low, high] = std::ranges::minmax(one);
        EXPECT_NEAR(low, 1.7, 1e-14);
        EXPECT_NEAR(high, 1.7, 1e-14);
        EXPECT_GE(*std::ranges::min_element(some), least - 1e-15);
        EXPECT_LE(*std::ranges::max_element(some), largest + 1e-15);
      }
      return result;
    }

    TEST(RefinableMesh, CarriesHeatOverToRoundOff)
    {
      for(const Carried &carried : {carry_over_random_meshes(domain_of(2), 2, 64, 40),
                                    carry_over_random_meshes(domain_of(3), 3, 32, 12),
                                    carry_over_random_meshes(half_section(), 2, 64, 40)})
      {
        EXPECT_GE(carried.changes, 12);
        EXPECT_LE(carried.worst_change, 1e-14);
      }
    }

    /** Where cells are only halved, what is linear stays so. */
    TEST(RefinableMesh, HalvingKeepsLinearFields)
    {
      const cases::Scene scene = domain_of(3);
      const auto mesh = make_refinable_mesh(scene, 3, 64);
      std::mt19937 random(3);
      const auto linear = [](const Position &p) { return 2 * p[0] - p[1] + 3 * p[2]; };
      std::vector<double> field;
      for(const Position &p : mesh->discretise().positions)
        field.push_back(linear(p));
      for(int round = 0; round < 2; ++round)
        ASSERT_TRUE(mesh->adapt(random_wishes(*mesh, 0, random), {&field}));
      const Discretisation now = mesh->discretise();
      ASSERT_EQ(field.size(), now.positions.size());
      for(std::size_t i = 0; i < field.size(); ++i)
        EXPECT_NEAR(field[i], linear(now.positions[i]), 1e-14);
    }

    TEST(RefinableMesh, SharesAndAverages)
    {
      const cases::Scene scene = domain_of(2);
      const auto mesh = make_refinable_mesh(scene, 2, 64);
      std::mt19937 random(5);
      mesh->adapt(random_wishes(*mesh, 0, random), {});
      const Discretisation now = mesh->discretise();
      for(const Position &p : {Position{0.3, 0.2, 0}, {1, 0.75, 0}, {0.501, 0.4999, 0}})
      {
        double sum = 0, x = 0;
        for(const auto &[node, share] : mesh->shares(p))
        {
          sum += share;
          x += share * now.positions[node][0];
        }
        EXPECT_NEAR(sum, 1, 1e-14);
        EXPECT_NEAR(x, p[0], 1e-14);
      }
      EXPECT_THROW(mesh->shares({1.1, 0.2, 0}), cases::InputError);
      const std::vector<double> averages
          = mesh->node_averages([](const Position &p) { return 1 + p[0] * p[1]; },
                                [](const Position &p) { return p[0] < 0.5; }, false);
      EXPECT_NEAR(held(now, averages), 0.75 + 0.5 * 0.75 * 0.75 / 2, 1e-12);
      const auto step = [](const Position &p) { return p[0] < 0.437; };
      for(const bool phases : {false, true})
      {
        const std::vector<double> jumping = mesh->node_averages(
            [&](const Position &p) { return step(p) ? 3. : 1.; },
            [&](const Position &p) { return phases && step(p); }, !phases);
        EXPECT_NEAR(held(now, jumping), 0.75 + 2 * 0.437 * 0.75, 2 * 0.75 * 1e-3);
      }
    }
  } // namespace
} // namespace meltfront::reference_fem
