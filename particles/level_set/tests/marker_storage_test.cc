#include "marker_samples.h"

#include <cases/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace meltfront::particles::level_set
{
  namespace
  {
    TEST(MarkerCells, SortedMarkersLieInTheirCellsInTheirOrderBefore)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid = unit_grid(dimension == 2 ? 40 : 16, dimension);
        Markers markers
            = seed_markers(grid, dimension == 2 ? circle : sphere, SeedingParameters{});
        MarkerCells cells(grid);
        cells.sort(markers);
        ASSERT_GT(cells.size(), 50u);
        EXPECT_EQ(cells.first(cells.size()), markers.size());
        for(std::size_t cell = 0; cell < cells.size(); ++cell)
        {
          EXPECT_LE(cells.first(cell + 1) - cells.first(cell), cells.fullest());
          EXPECT_EQ(cells.markers_of(cells.key(cell)),
                    std::pair(cells.first(cell), cells.first(cell + 1)));
          for(std::size_t p = cells.first(cell); p < cells.first(cell + 1); ++p)
          {
            const Position low = grid.position(cells.key(cell));
            for(int d = 0; d < dimension; ++d)
            {
              EXPECT_GE(markers.position[d][p], low[d] - 1e-14);
              EXPECT_LE(markers.position[d][p], low[d] + grid.spacing() + 1e-14);
            }
            EXPECT_TRUE(p == cells.first(cell)
                        || markers.birth[p - 1] < markers.birth[p]);
          }
        }
      }
    }

    TEST(MarkerCells, NodesAreTheCornersOfCellsWithMarkersEachOnce)
    {
      const Grid grid = unit_grid(8);
      Markers markers = given_markers({{{0.3, 0.3, 0}, 0, {1, 0, 0}},
                                       {{0.31, 0.45, 0}, 0, {1, 0, 0}},
                                       {{-0.1, 0.3, 0}, 0, {1, 0, 0}}});
      MarkerCells cells(grid);
      cells.sort(markers);
      std::set<std::size_t> expected;
      for(const std::array<int, 2> node :
          {std::array{2, 2}, {3, 2}, {2, 3}, {3, 3}, {2, 4}, {3, 4}, {0, 2}, {0, 3}})
        expected.insert(grid.node(node[0], node[1]));
      EXPECT_EQ(cells.nodes().size(), expected.size());
      EXPECT_EQ(std::set<std::size_t>(cells.nodes().begin(), cells.nodes().end()),
                expected);
    }

    TEST(MarkerCells, ThoseFurtherOutsideThanASpacingAreDropped)
    {
      const Grid grid = unit_grid(10);
      Markers markers = given_markers({{{-0.05, 0.5, 0}, 0.01, {1, 0, 0}},
                                       {{-0.15, 0.5, 0}, 0.02, {1, 0, 0}},
                                       {{0.5, 1.05, 0}, 0.03, {1, 0, 0}},
                                       {{0.5, 7e300, 0}, 0.04, {1, 0, 0}}});
      MarkerCells cells(grid);
      cells.sort(markers);
      ASSERT_EQ(markers.size(), 2u);
      EXPECT_EQ(std::set<double>(markers.distance.begin(), markers.distance.end()),
                (std::set<double>{0.01, 0.03}));
      markers = given_markers({});
      cells.sort(markers);
      EXPECT_EQ(cells.size(), 0u);
      EXPECT_TRUE(cells.nodes().empty());
      EXPECT_EQ(cells.fullest(), 0u);
    }

    TEST(MarkerSeeding, MarkersKnowTheTrueFront)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid = unit_grid(dimension == 2 ? 80 : 24, dimension);
        const DistanceFunction distance = dimension == 2 ? circle : sphere;
        const Position centre
            = dimension == 2 ? Position{0.5, 0.75, 0} : Position{0.35, 0.35, 0.35};
        const Markers markers = seed_markers(grid, distance, SeedingParameters{});
        double near = 0;
        for(std::size_t p = 0; p < markers.size(); ++p)
        {
          const Position at = markers.point(p);
          EXPECT_EQ(markers.distance[p], distance(at));
          EXPECT_LE(std::abs(markers.distance[p]), 1.5 * grid.spacing());
          near += std::abs(markers.distance[p]) <= grid.spacing();
          const double radius
              = std::hypot(at[0] - centre[0], at[1] - centre[1], at[2] - centre[2]);
          for(int d = 0; d < dimension; ++d)
            EXPECT_NEAR(markers.normal[d][p], (centre[d] - at[d]) / radius, 1e-8);
        }
        // 12 per cell, all of a band of two spacings along the front filled
        const double front = dimension == 2 ? 2 * M_PI * 0.15 : 4 * M_PI * 0.15 * 0.15;
        const double cells = 2 * front / std::pow(grid.spacing(), dimension - 1);
        EXPECT_NEAR(near / (12 * cells), 1, 0.05);
      }
    }

    TEST(MarkerSeeding, IsReproducibleBySeedAndCell)
    {
      const Grid grid = unit_grid(40);
      SeedingParameters parameters;
      const Markers first = seed_markers(grid, circle, parameters);
      EXPECT_EQ(first.position, seed_markers(grid, circle, parameters).position);
      // a second front elsewhere changes nothing at the first
      const Markers both = seed_markers(
          grid, [](const Position &p) { return std::max(circle(p), 0.1 - p[1]); },
          parameters);
      std::set<std::pair<double, double>> places;
      for(std::size_t p = 0; p < both.size(); ++p)
        places.insert({both.position[0][p], both.position[1][p]});
      for(std::size_t p = 0; p < first.size(); ++p)
        EXPECT_TRUE(places.contains({first.position[0][p], first.position[1][p]}));
      std::set<double> coordinates(first.position[0].begin(), first.position[0].end());
      EXPECT_EQ(coordinates.size(), first.size());
      parameters.seed = 2;
      const Markers other = seed_markers(grid, circle, parameters);
      for(const double x : other.position[0])
        EXPECT_FALSE(coordinates.contains(x));
    }

    TEST(MarkerSeeding, WithoutAFrontThereAreNoMarkers)
    {
      const auto nowhere = [](const Position &) { return -1.; };
      EXPECT_EQ(seed_markers(unit_grid(20), nowhere, SeedingParameters{}).size(), 0u);
    }

    TEST(MarkerSeeding, RefusesWhatMakesNoSense)
    {
      const Grid grid = unit_grid(20);
      SeedingParameters parameters;
      parameters.per_cell = 0;
      EXPECT_THROW(seed_markers(grid, circle, parameters), cases::InputError);
      parameters = {};
      parameters.nearest = 2;
      EXPECT_THROW(seed_markers(grid, circle, parameters), cases::InputError);
      const auto steep = [](const Position &p) { return 3 * circle(p); };
      EXPECT_THROW(seed_markers(grid, steep, SeedingParameters{}), cases::InputError);
      const auto wild = [](const Position &p)
      { return p[0] > 0.5 ? std::numeric_limits<double>::quiet_NaN() : 1; };
      EXPECT_THROW(seed_markers(grid, wild, SeedingParameters{}), cases::InputError);
    }

    TEST(MarkerSeeding, RadiiAreHeldBetweenATenthAndHalfASpacing)
    {
      EXPECT_EQ(signed_radius(0.3, 1), 0.3);
      EXPECT_EQ(signed_radius(-0.01, 1), -0.1);
      EXPECT_EQ(signed_radius(2, 1), 0.5);
      EXPECT_EQ(signed_radius(-2, 0.1), -0.05);
    }

    TEST(MarkerReseeding, AMidpointOnACircleHasTheDistanceOfTheCircle)
    {
      const Grid grid = unit_grid(40);
      const double angle = 0.8 * grid.spacing() / 0.15;
      std::vector<GivenMarker> list;
      for(const double a : {0.3, 0.3 + angle})
        for(const double inwards : {0., 0.6 * grid.spacing()})
        {
          const double r = 0.15 - inwards;
          list.push_back({{0.5 + r * std::cos(a), 0.75 + r * std::sin(a), 0},
                          inwards,
                          {-std::cos(a), -std::sin(a), 0}});
        }
      Markers markers = given_markers(list);
      MarkerCells cells(grid);
      MarkerReseeding reseeding(grid, {});
      reseeding.apply(markers, cells, at_nodes(grid, circle));
      EXPECT_EQ(reseeding.born(), 2u);
      ASSERT_EQ(markers.size(), 6u);
      for(std::size_t p = 0; p < markers.size(); ++p)
      {
        // of fourth order in the angle: (angle/2)^4/24 of the radius
        const Position at = markers.point(p);
        EXPECT_NEAR(markers.distance[p], circle(at), 2e-5);
        EXPECT_NEAR(markers.normal[0][p] * (at[1] - 0.75)
                        - markers.normal[1][p] * (at[0] - 0.5),
                    0, 1e-12);
      }
      std::set<std::uint32_t> names(markers.birth.begin(), markers.birth.end());
      EXPECT_EQ(names.size(), 6u);
    }

    TEST(MarkerReseeding, NothingIsBornBetweenTwoFronts)
    {
      const Grid grid = unit_grid(40);
      const double dx = grid.spacing();
      // the two sides of a filament, 0.8 spacings thick: a gap along no tangent
      Markers markers
          = given_markers({{{0.5, 0.5, 0}, 0, {0, 1, 0}},
                           {{0.5, 0.5 + 0.8 * dx, 0}, 0, {0, -1, 0}},
                           {{0.5 + 0.7 * dx, 0.5 + 0.4 * dx, 0}, 0.4 * dx, {0, -1, 0}}});
      MarkerCells cells(grid);
      MarkerReseeding reseeding(grid, {});
      reseeding.apply(markers, cells,
                      at_nodes(grid, [](const Position &) { return 0.; }));
      // only between the two markers of the upper side
      EXPECT_EQ(reseeding.born(), 1u);
    }

    TEST(MarkerReseeding, InSpaceHolesCloseWithTheDistanceOfTheSurface)
    {
      const Grid grid = unit_grid(24, 3);
      SeedingParameters sparse;
      sparse.per_cell = 6;
      Markers markers = seed_markers(grid, sphere, sparse);
      MarkerCells cells(grid);
      ReseedingParameters parameters;
      parameters.seeding.per_cell = 24;
      parameters.most = 100;
      MarkerReseeding reseeding(grid, parameters);
      const std::size_t before = markers.size();
      reseeding.apply(markers, cells, at_nodes(grid, sphere));
      EXPECT_GT(markers.size(), before + before / 4);
      // d of a midpoint is of fourth order in the angle: (1.2 / 2 dx / R)^4 / 24 R
      for(std::size_t p = 0; p < markers.size(); ++p)
        EXPECT_NEAR(markers.distance[p], sphere(markers.point(p)), 5e-3 * grid.spacing());
    }

    TEST(MarkerReseeding, FarMarkersGoAndCrowdedCellsLoseTheYoungest)
    {
      const Grid grid = unit_grid(40);
      const double dx = grid.spacing();
      std::vector<GivenMarker> list{{{0.1, 0.1, 0}, 3.5 * dx, {1, 0, 0}},
                                    {{0.1, 0.1, 0}, 1.5 * dx, {1, 0, 0}},
                                    {{0.1, 0.1, 0}, 0.5 * dx, {1, 0, 0}}};
      for(int n = 0; n < 10; ++n)
        list.push_back({{0.5126, 0.6126 + 1e-4 * n, 0}, 0, {1, 0, 0}});
      Markers markers = given_markers(list);
      MarkerCells cells(grid);
      ReseedingParameters parameters;
      parameters.seeding.per_cell = 2;
      parameters.most = 4;
      MarkerReseeding reseeding(grid, parameters);
      reseeding.apply(markers, cells, at_nodes(grid, circle));
      std::ranges::sort(markers.birth);
      EXPECT_EQ(markers.birth, (std::vector<std::uint32_t>{2, 3, 4, 5, 6}));
    }

    TEST(MarkerReseeding, FromTheGridCellsNearTheFrontFillUp)
    {
      const Grid grid = unit_grid(40);
      SeedingParameters sparse;
      sparse.per_cell = 3;
      Markers markers = seed_markers(grid, circle, sparse);
      MarkerCells cells(grid);
      ReseedingParameters parameters;
      parameters.rule = ReseedingRule::grid;
      MarkerReseeding reseeding(grid, parameters);
      const std::size_t before = markers.size();
      const std::vector<double> phi = at_nodes(grid, circle);
      reseeding.apply(markers, cells, phi);
      EXPECT_GT(markers.size(), 3 * before);
      for(std::size_t p = 0; p < markers.size(); ++p)
        EXPECT_NEAR(markers.distance[p], circle(markers.point(p)), 0.05 * grid.spacing());
      const std::size_t after = markers.size();
      reseeding.apply(markers, cells, phi);
      EXPECT_LT(markers.size(), after + after / 4);
    }

    TEST(MarkerReseeding, RefusesACrowdBelowTheQuota)
    {
      ReseedingParameters parameters;
      parameters.most = 5;
      EXPECT_THROW(MarkerReseeding(unit_grid(20), parameters), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::level_set
