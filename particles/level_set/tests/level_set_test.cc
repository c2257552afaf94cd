#include <cases/error.h>
#include <particles/level_set/tests/shapes.h>

#include <gtest/gtest.h>

#include <set>

namespace meltfront::particles::level_set
{
  namespace
  {
    TEST(Grid, NumbersAndPlacesBelongTogether)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid(dimension, {-1, 2, 3}, 0.25, {5, 6, 7});
        std::set<std::size_t> seen;
        for(int k = 0; k < grid.nodes(2); ++k)
          for(int j = 0; j < grid.nodes(1); ++j)
            for(int i = 0; i < grid.nodes(0); ++i)
            {
              const std::size_t node = grid.node(i, j, k);
              EXPECT_TRUE(seen.insert(node).second);
              EXPECT_LT(node, grid.size());
              EXPECT_EQ(grid.indices(node), (std::array<int, 3>{i, j, k}));
            }
        EXPECT_EQ(grid.position(grid.node(5, 6, grid.nodes(2) - 1)),
                  (Position{0.25, 3.5, dimension == 3 ? 4.75 : 0.}));
      }
    }

    TEST(Grid, InterpolationIsExactForLinearFunctionsEvenOutside)
    {
      for(const int dimension : {2, 3})
      {
        const LevelSet plane(unit_grid(8, dimension),
                             [](const Position &p)
                             { return 1 + 2 * p[0] - 3 * p[1] + 0.5 * p[2]; },
                             {0, 1});
        for(const Position &p : {Position{0.3, 0.72, 0.11}, Position{-0.2, 1.3, 0.5},
                                 Position{1, 1, 1}, Position{0, 0, 0}})
        {
          const double z = dimension == 3 ? p[2] : 0;
          EXPECT_NEAR(plane.value(p), 1 + 2 * p[0] - 3 * p[1] + 0.5 * z, 1e-14);
          const Position slope = plane.gradient(p);
          EXPECT_NEAR(slope[0], 2, 1e-13);
          EXPECT_NEAR(slope[1], -3, 1e-13);
          EXPECT_NEAR(slope[2], dimension == 3 ? 0.5 : 0, 1e-13);
        }
      }
    }

    TEST(Grid, RefusesWhatIsNoGrid)
    {
      EXPECT_THROW(Grid(1, {}, 0.1, {8, 8, 8}), cases::InputError);
      EXPECT_THROW(Grid(2, {}, 0, {8, 8, 8}), cases::InputError);
      EXPECT_THROW(Grid(2, {}, NAN, {8, 8, 8}), cases::InputError);
      EXPECT_THROW(Grid(2, {}, 0.1, {8, 3, 8}), cases::InputError);
      EXPECT_THROW(Grid(3, {}, 0.1, {2000, 2000, 2000}), cases::InputError);
      EXPECT_THROW(Grid(2, {0, NAN, 0}, 0.1, {8, 8, 8}), cases::InputError);
    }

    /** The nodes no further than `layers` from the set, one by one. */
    std::set<std::array<int, 3>>
    dilated_by_hand(const Grid &grid, const std::vector<Interval> &intervals, int layers)
    {
      const int up = grid.dimension() == 3 ? layers : 0;
      std::set<std::array<int, 3>> result;
      for(const Interval &interval : intervals)
        for(int n = interval.begin; n < interval.end; ++n)
          for(int k = std::max(interval.k - up, 0);
              k <= std::min(interval.k + up, grid.nodes(2) - 1); ++k)
            for(int j = std::max(interval.j - layers, 0);
                j <= std::min(interval.j + layers, grid.nodes(1) - 1); ++j)
              for(int i = std::max(n - layers, 0);
                  i <= std::min(n + layers, grid.nodes(0) - 1); ++i)
                result.insert({i, j, k});
      return result;
    }

    TEST(Band, DilationTakesAllNodesWithinTheLayersAndNoOthers)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid(dimension, {0, 0, 0}, 1, {17, 11, 9});
        const int top = grid.nodes(2) - 1;
        const std::vector<Interval> set{
            {0, 0, 0, 1}, {0, 2, 16, 18}, {0, 5, 4, 5}, {top, 9, 3, 6}};
        for(const int layers : {0, 1, 2, 3, 6, 20})
        {
          const Band band(grid, dilated(grid, set, layers));
          std::set<std::array<int, 3>> found;
          for(const NodeRun &run : band.runs())
            for(int n = 0; n < run.length; ++n)
            {
              EXPECT_EQ(grid.node(run.index) + n, run.node + n);
              EXPECT_TRUE(
                  found.insert({run.index[0] + n, run.index[1], run.index[2]}).second);
            }
          EXPECT_EQ(found, dilated_by_hand(grid, set, layers));
          EXPECT_EQ(band.size(), found.size());
        }
      }
    }

    TEST(LevelSet, BandHoldsTheFrontAndGrowsWithItsLength)
    {
      std::vector<double> sizes;
      for(const int cells : {40, 80, 160, 320})
      {
        const LevelSet front(unit_grid(cells), distance_from(disk));
        sizes.push_back(double(front.band().size()));
        for(const NodeRun &run : front.band().runs())
          for(int n = 0; n < run.length; ++n)
            EXPECT_DOUBLE_EQ(front.values()[run.node + n],
                             disk.signed_distance(front.grid().position(
                                 {run.index[0] + n, run.index[1], 0})));
      }
      EXPECT_NEAR(std::log2(sizes[3] / sizes[2]), 1, 0.1);
    }

    TEST(LevelSet, SignsHoldEverywhere)
    {
      for(const int dimension : {2, 3})
      {
        const ScalarFunction shape = distance_from(dimension == 2 ? disk : ball);
        const LevelSet front(unit_grid(40, dimension), shape);
        const Band all(front.grid(), whole_grid(front.grid()));
        for(const NodeRun &run : all.runs())
          for(int n = 0; n < run.length; ++n)
          {
            const Position p
                = front.grid().position({run.index[0] + n, run.index[1], run.index[2]});
            EXPECT_EQ(front.values()[run.node + n] > 0, shape(p) > 0);
          }
      }
    }

    /** Mean error of distances marched from within a tenth of the front. */
    double marching_error(int cells, int dimension)
    {
      const ScalarFunction shape = distance_from(dimension == 2 ? disk : ball);
      const LevelSet front(unit_grid(cells, dimension), shape, {cells / 10, 1});
      const std::vector<double> distance = front.distances_everywhere();
      double sum = 0, count = 0;
      const Band all(front.grid(), whole_grid(front.grid()));
      for(const NodeRun &run : all.runs())
        for(int n = 0; n < run.length; ++n, ++count)
        {
          const Position p
              = front.grid().position({run.index[0] + n, run.index[1], run.index[2]});
          sum += std::abs(distance[run.node + n] - shape(p));
        }
      return sum / count;
    }

    TEST(LevelSet, FastMarchingIsOfFirstOrder)
    {
      const std::vector<std::vector<int>> levels{{40, 80, 160, 320}, {40, 50, 60, 80}};
      for(const int dimension : {2, 3})
      {
        const std::vector<int> &cells = levels[dimension - 2];
        std::vector<double> errors;
        for(const int n : cells)
          errors.push_back(marching_error(n, dimension));
        const double order = std::log(errors.front() / errors.back())
                             / std::log(double(cells.back()) / cells.front());
        EXPECT_GT(order, 0.9) << dimension << "D " << errors[0] << " ... " << errors[3];
        EXPECT_LT(order, 1.2);
      }
    }

    TEST(LevelSet, RebuildingFollowsAFrontThatMoved)
    {
      LevelSet front(unit_grid(80), distance_from(disk));
      const double spacing = front.grid().spacing();
      for(int step = 1; step <= 20; ++step)
      {
        for(const NodeRun &run : front.band_with_halo().runs())
          for(int n = 0; n < run.length; ++n)
          {
            Position p = front.grid().position({run.index[0] + n, run.index[1], 0});
            p[0] -= 0.9 * spacing * step;
            front.values()[run.node + n] = disk.signed_distance(p);
          }
        front.rebuild_band();
      }
      for(int n = 0; n < 100; ++n)
      {
        const double angle = 2 * std::numbers::pi * n / 100;
        const Position on_front{0.5 + 18 * spacing + 0.15 * std::cos(angle),
                                0.75 + 0.15 * std::sin(angle), 0};
        EXPECT_NEAR(front.value(on_front), 0, 0.015 * spacing);
      }
      EXPECT_DOUBLE_EQ(front.value({0.2, 0.75, 0}), -front.far_value());
    }

    TEST(LevelSet, StandsWithoutAFront)
    {
      LevelSet none(unit_grid(20), [](const Position &) { return -1.; });
      EXPECT_EQ(none.band().size(), 0u);
      none.rebuild_band();
      EXPECT_LT(none.value({0.5, 0.5, 0}), 0);
      EXPECT_LT(none.distances_everywhere()[none.grid().node(3, 3)], 0);
    }

    TEST(LevelSet, RefusesStartsThatAreNoNumbers)
    {
      EXPECT_THROW(LevelSet(unit_grid(8), [](const Position &p) { return 1 / p[0] - 1; }),
                   cases::InputError);
      EXPECT_THROW(LevelSet(unit_grid(8), distance_from(disk), {2, 1}),
                   cases::InputError);
      EXPECT_THROW(LevelSet(unit_grid(8), distance_from(disk), {6, 0}),
                   cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::level_set
