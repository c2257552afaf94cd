#include "marker_samples.h"

#include <cases/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace meltfront::particles::level_set
{
  namespace
  {
    /** Zero of a level set along rows of nodes, off a plane x = front (spacings). */
    struct Offset
    {
      double mean = 0, spread = 0;
    };

    Offset offset_of_plane(const Grid &grid, const std::vector<double> &phi, double front)
    {
      double sum = 0, squares = 0;
      int rows = 0;
      for(int j = 5; j <= grid.cells(1) - 5; ++j)
        for(int i = 30; i < 50; ++i)
        {
          const double left = phi[grid.node(i, j)], right = phi[grid.node(i + 1, j)];
          if(!(left <= 0 && right > 0))
            continue;
          const double zero
              = (grid.coordinate(0, i) - front) / grid.spacing() + left / (left - right);
          sum += zero;
          squares += zero * zero;
          ++rows;
        }
      const double mean = sum / rows;
      return {mean, std::sqrt(std::max(0., squares / rows - mean * mean))};
    }

    /**
     * Pseudo-1D test of the report's section 4.3.1: the grid holds the true plane less
     * half a spacing, its zero set lies half a spacing off.
     */
    Offset shifted_plane(const MarkerParameters &parameters, double front)
    {
      const Grid grid = unit_grid(80);
      const auto plane = [&](const Position &p) { return p[0] - front; };
      std::vector<double> phi = at_nodes(grid, [&](const Position &p)
                                         { return plane(p) - 0.5 * grid.spacing(); });
      SeedingParameters seeding;
      seeding.per_cell = parameters.per_cell;
      seeding.normals = parameters.interpolative;
      seeding.seed = parameters.seed;
      if(!parameters.interpolative)
      {
        seeding.nearest = 0.1;
        seeding.band = seeding.furthest = 3;
      }
      Markers markers = seed_markers(grid, plane, seeding);
      MarkerCells cells(grid);
      cells.sort(markers);
      if(parameters.interpolative)
        fit_level_set(grid, markers, cells, parameters.fit, phi, 1);
      else
      {
        for(double &distance : markers.distance)
          distance = signed_radius(distance, grid.spacing());
        EXPECT_GT(EscapeCorrection(grid, parameters.escape, 1).correct(markers, phi),
                  600u);
      }
      return offset_of_plane(grid, phi, front);
    }

    constexpr double on_node = 0.5, mid_cell = 0.5 + 0.5 / 80;

    TEST(ShiftedPlane, FitsRestoreItToRoundOff)
    {
      for(const bool clustered : {false, true})
        for(const double front : {on_node, mid_cell})
          for(const std::uint64_t seed : {1, 2, 3, 4, 5})
          {
            MarkerParameters parameters = MarkerParameters::interpolating(2, clustered);
            parameters.seed = seed;
            const Offset offset = shifted_plane(parameters, front);
            EXPECT_NEAR(offset.mean, 0, 1e-6);
            EXPECT_NEAR(offset.spread, 0, 1e-6);
          }
    }

    /**
     * With the front mid-cell the nodes lie half a spacing to either side of it and the
     * grid has 0 at the right one. Escaped markers have d < dx/4: the original scheme
     * offers the right node 2 d - dx/2 <= 0, the corrected one dx/2, which the rule of
     * the smaller magnitude vetoes.
     */
    TEST(ShiftedPlane, MidCellTheRuleOfTheSmallerMagnitudeVetoesEveryCorrection)
    {
      for(const std::uint64_t seed : {1, 2, 3, 4, 5})
        for(MarkerParameters parameters :
            {MarkerParameters::original(), MarkerParameters::corrected()})
        {
          parameters.seed = seed;
          const Offset offset = shifted_plane(parameters, mid_cell);
          EXPECT_NEAR(offset.mean, 0.5, 1e-6);
          EXPECT_NEAR(offset.spread, 0, 1e-6);
        }
    }

    TEST(ShiftedPlane, MidCellReplacingRestoresItUpToTheSpacingOfMarkers)
    {
      for(const std::uint64_t seed : {1, 2, 3, 4, 5})
      {
        MarkerParameters parameters = MarkerParameters::corrected(EscapeMerge::replace);
        parameters.seed = seed;
        const Offset offset = shifted_plane(parameters, mid_cell);
        EXPECT_NEAR(offset.mean, 0.02, 0.04);
        EXPECT_LT(offset.spread, 0.2);
      }
    }

    /** Means over five seeds; an independent code has 0.035, 0.16 and 0.11 from one. */
    TEST(ShiftedPlane, OnANodeEscapedMarkersComeNear)
    {
      const auto mean_offset = [](MarkerParameters parameters)
      {
        double sum = 0;
        for(const std::uint64_t seed : {1, 2, 3, 4, 5})
        {
          parameters.seed = seed;
          sum += shifted_plane(parameters, on_node).mean / 5;
        }
        return sum;
      };
      EXPECT_NEAR(mean_offset(MarkerParameters::original()), 0.025, 0.012);
      EXPECT_NEAR(mean_offset(MarkerParameters::corrected()), 0.11, 0.055);
      EXPECT_NEAR(mean_offset(MarkerParameters::corrected(EscapeMerge::replace)), 0.075,
                  0.035);
    }

    TEST(EscapeCorrection, OneSphereSetsTheCornersOfItsCellByHand)
    {
      const Grid grid = unit_grid(10);
      std::vector<double> phi(grid.size(), -0.08);
      const Markers markers
          = given_markers({{{0.52, 0.53, 0}, 0.05, {}}, {{0.21, 0.22, 0}, -0.05, {}}});
      EscapeCorrection correction(grid, {}, 1);
      EXPECT_EQ(correction.correct(markers, phi), 1u);
      int changed = 0;
      for(std::size_t node = 0; node < grid.size(); ++node)
        changed += phi[node] != -0.08;
      EXPECT_EQ(changed, 4);
      EXPECT_NEAR(phi[grid.node(5, 5)], 0.05 - std::hypot(0.02, 0.03), 1e-15);
      EXPECT_NEAR(phi[grid.node(6, 5)], 0.05 - std::hypot(0.08, 0.03), 1e-15);
      EXPECT_NEAR(phi[grid.node(6, 6)], 0.05 - std::hypot(0.08, 0.07), 1e-15);
      // whoever finds nobody escaped changes nothing
      const std::vector<double> before = phi;
      EXPECT_EQ(correction.correct(given_markers({}), phi), 0u);
      EXPECT_EQ(phi, before);
    }

    TEST(EscapeCorrection, RadiiFollowTheGridOnlyOfThoseThatHaveNotEscaped)
    {
      const Grid grid = unit_grid(10);
      const std::vector<double> phi
          = at_nodes(grid, [](const Position &p) { return p[0] - 0.5; });
      Markers markers = given_markers({{{0.53, 0.5, 0}, 0.05, {}},
                                       {{0.3, 0.5, 0}, 0.05, {}},
                                       {{0.3, 0.5, 0}, -0.02, {}},
                                       {{0.495, 0.5, 0}, 0.02, {}}});
      EscapeCorrection(grid, {}, 1).reset_radii(markers, phi);
      EXPECT_NEAR(markers.distance[0], 0.03, 1e-15);
      EXPECT_EQ(markers.distance[1], 0.05);
      EXPECT_NEAR(markers.distance[2], -0.05, 1e-15);
      EXPECT_NEAR(markers.distance[3], 0.01, 1e-15);
    }

    /** Random markers whose distances are any function's; the grid holds zero. */
    Markers strewn(const Grid &grid, const DistanceFunction &function,
                   std::uint32_t per_cell)
    {
      SeedingParameters seeding;
      seeding.per_cell = per_cell;
      std::vector<std::uint32_t> keys;
      for(std::size_t node = 0; node < grid.size(); ++node)
      {
        const std::array<int, 3> cell = grid.indices(node);
        bool inside = true;
        for(int d = 0; d < grid.dimension(); ++d)
          inside = inside && cell[d] >= -1 && cell[d] <= grid.cells(d);
        if(inside)
          keys.push_back(static_cast<std::uint32_t>(node));
      }
      Markers markers;
      markers.dimension = grid.dimension();
      std::uint32_t births = 0;
      seed_in_cells(
          grid, [](const Position &) { return 0.; }, seeding, keys,
          std::vector<std::uint32_t>(keys.size(), per_cell), 0, markers, births);
      for(std::size_t p = 0; p < markers.size(); ++p)
        markers.distance[p] = function(markers.point(p));
      return markers;
    }

    FitCounts fit(const Grid &grid, Markers markers, const FitParameters &parameters,
                  std::vector<double> &phi, int threads = 1)
    {
      MarkerCells cells(grid);
      cells.sort(markers);
      return fit_level_set(grid, markers, cells, parameters, phi, threads);
    }

    TEST(MarkerFit, ReproducesQuadraticsAndWithFewMarkersLinearFunctions)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid = unit_grid(10, dimension);
        const auto bowl = [](const Position &p)
        { return 0.02 + 0.1 * p[0] * p[0] - 0.2 * p[0] * p[1] + 0.07 * p[2] * p[1]; };
        const auto plane = [](const Position &p)
        { return 0.02 + 0.1 * p[0] - 0.2 * p[1] + 0.07 * p[2]; };
        FitParameters parameters = FitParameters::in(dimension);
        parameters.clustered = false;
        parameters.nearest = parameters.furthest = 100;
        std::vector<double> phi(grid.size(), 0);
        FitCounts counts
            = fit(grid, strewn(grid, bowl, dimension == 2 ? 12 : 8), parameters, phi);
        const std::size_t nodes
            = dimension == 2 ? std::size_t(11 * 11) : std::size_t(11 * 11 * 11);
        EXPECT_EQ(counts.quadratic, nodes);
        for(int i = 0; i <= 10; ++i)
          for(int j = 0; j <= 10; ++j)
          {
            const std::size_t node = grid.node(i, j, dimension == 3 ? i : 0);
            EXPECT_NEAR(phi[node], bowl(grid.position(node)), 1e-10);
          }
        parameters.quadratic = 1000;
        counts = fit(grid, strewn(grid, plane, 6), parameters, phi);
        EXPECT_GT(counts.linear, nodes * 9 / 10);
        EXPECT_EQ(counts.quadratic, 0u);
        for(int i = 3; i <= 7; ++i)
        {
          const std::size_t node = grid.node(i, i, dimension == 3 ? i : 0);
          EXPECT_NEAR(phi[node], plane(grid.position(node)), 1e-12);
        }
      }
    }

    TEST(MarkerFit, MirroredMarkersGiveAMirroredLevelSet)
    {
      const Grid grid = unit_grid(20);
      // no node exactly two spacings from the front, where round-off would decide
      const auto disk
          = [](const Position &p) { return 0.16 - std::hypot(p[0] - 0.5, p[1] - 0.75); };
      Markers markers = seed_markers(grid, disk, SeedingParameters{});
      Markers mirrored = markers;
      for(std::size_t p = 0; p < markers.size(); ++p)
      {
        mirrored.position[0][p] = 1 - markers.position[0][p];
        mirrored.normal[0][p] = -markers.normal[0][p];
      }
      for(const bool clustered : {false, true})
      {
        FitParameters parameters;
        parameters.clustered = clustered;
        const std::vector<double> start = at_nodes(grid, disk);
        std::vector<double> phi = start, other = start;
        fit(grid, markers, parameters, phi);
        fit(grid, mirrored, parameters, other);
        EXPECT_NE(phi, start);
        for(int j = 0; j <= 20; ++j)
          for(int i = 0; i <= 20; ++i)
            EXPECT_NEAR(phi[grid.node(i, j)], other[grid.node(20 - i, j)], 1e-12);
      }
    }

    TEST(MarkerFit, ThreadsDoNotChangeABit)
    {
      for(const int dimension : {2, 3})
      {
        const Grid grid = unit_grid(dimension == 2 ? 40 : 16, dimension);
        const DistanceFunction distance = dimension == 2 ? circle : sphere;
        const Markers markers = seed_markers(grid, distance, SeedingParameters{});
        std::vector<double> one = at_nodes(grid, distance), two = one;
        fit(grid, markers, FitParameters::in(dimension), one, 1);
        fit(grid, markers, FitParameters::in(dimension), two, 2);
        EXPECT_EQ(one, two);
      }
    }

    TEST(MarkerFit, OneMarkerInACell)
    {
      const Grid grid = unit_grid(10);
      const Position n{0.6, 0.8, 0};
      const Markers markers = given_markers({{{0.54, 0.55, 0}, 0.01, n}});
      FitParameters parameters;
      parameters.clustered = false;
      const std::vector<double> start(grid.size(), 0.03);
      std::vector<double> phi = start;
      FitCounts counts = fit(grid, markers, parameters, phi);
      EXPECT_EQ(counts.left, 4u);
      EXPECT_EQ(phi, start);
      // its tangent plane at the corner that it is near enough to, of weight 0.6 0.5
      parameters.clustered = true;
      parameters.weight = 0.29;
      counts = fit(grid, markers, parameters, phi);
      EXPECT_EQ(counts.mean, 2u);
      EXPECT_EQ(counts.left, 2u);
      EXPECT_NEAR(phi[grid.node(5, 5)], 0.01 - 0.04 * 0.6 - 0.05 * 0.8, 1e-15);
    }

    TEST(MarkerFit, MarkersOnALine)
    {
      const Grid grid = unit_grid(10);
      std::vector<GivenMarker> list;
      for(int k = 0; k < 40; ++k)
        list.push_back({{0.402 + 0.005 * k, 0.452 + 0.0025 * k, 0}, 0, {-0.6, 0.8, 0}});
      FitParameters parameters;
      parameters.clustered = false;
      std::vector<double> phi(grid.size(), 0.03);
      FitCounts counts = fit(grid, given_markers(list), parameters, phi);
      EXPECT_EQ(counts.quadratic + counts.linear, 0u);
      EXPECT_GT(counts.left, 5u);
      parameters.clustered = true;
      counts = fit(grid, given_markers(list), parameters, phi);
      EXPECT_EQ(counts.quadratic, 0u);
      EXPECT_GT(counts.mean, 5u);
      for(const double value : phi)
        EXPECT_LT(std::abs(value), 0.2);
    }

    /** Phase in a strip of 0.4 spacings between two nodes' rows: no node is inside. */
    TEST(MarkerFit, FilamentThinnerThanASpacing)
    {
      const Grid grid = unit_grid(20);
      const double dx = grid.spacing(), middle = 0.5 + 0.3 * dx, half = 0.2 * dx;
      const auto strip
          = [&](const Position &p) { return half - std::abs(p[1] - middle); };
      Markers markers = seed_markers(grid, strip, SeedingParameters{});
      std::vector<double> phi(grid.size(), -0.5 * dx);
      FitCounts counts = fit(grid, markers, {}, phi);
      EXPECT_EQ(counts.left, 0u);
      for(int i = 0; i <= 20; ++i)
        for(const int j : {9, 10, 11})
        {
          const std::size_t node = grid.node(i, j);
          EXPECT_NEAR(phi[node], strip(grid.position(node)), 1e-6) << i << ' ' << j;
        }
      // a single polynomial goes through both sides and smears them
      FitParameters single;
      single.clustered = false;
      std::vector<double> smeared(grid.size(), -0.5 * dx);
      fit(grid, markers, single, smeared);
      double worst = 0;
      for(int i = 0; i <= 20; ++i)
        worst = std::max(worst, std::abs(smeared[grid.node(i, 10)]
                                         - strip(grid.position(grid.node(i, 10)))));
      EXPECT_GT(worst, 0.03 * dx);
    }

    TEST(MarkerFit, FrontAtTheBoundaryIsExactThere)
    {
      const Grid grid = unit_grid(20);
      for(const double front : {0., 0.3 / 20, 1.})
        for(const bool clustered : {false, true})
        {
          const auto plane = [&](const Position &p) { return p[0] - front; };
          FitParameters parameters;
          parameters.clustered = clustered;
          std::vector<double> phi(grid.size(), 0);
          fit(grid, seed_markers(grid, plane, SeedingParameters{}), parameters, phi);
          for(int j = 0; j <= 20; ++j)
          {
            const int i = static_cast<int>(std::lround(front * 20));
            EXPECT_NEAR(phi[grid.node(i, j)], i / 20. - front, 1e-8);
          }
        }
    }

    TEST(MarkerFit, WithoutMarkersOrFarFromTheFrontNothingChanges)
    {
      const Grid grid = unit_grid(20);
      std::vector<double> phi(grid.size(), -1), start = phi;
      FitCounts counts = fit(grid, given_markers({}), {}, phi);
      EXPECT_EQ(counts.left + counts.mean + counts.quadratic + counts.linear, 0u);
      fit(grid, seed_markers(grid, circle, SeedingParameters{}), {}, phi);
      EXPECT_EQ(phi, start);
    }

    TEST(MarkerFit, MarkersOutsideTheDomainSpeakToTheBoundaryOnly)
    {
      const Grid grid = unit_grid(10);
      std::vector<GivenMarker> list;
      std::mt19937 numbers(1);
      for(int k = 0; k < 200; ++k)
      {
        const double x = -0.1 + 0.1 * double(numbers()) / 4294967296.;
        list.push_back({{x, double(numbers()) / 4294967296., 0}, x, {1, 0, 0}});
      }
      list.push_back({{-5, 0.5, 0}, 0, {1, 0, 0}});
      list.push_back({{0.5, 1e9, 0}, 0, {1, 0, 0}});
      std::vector<double> phi(grid.size(), 0.05);
      const FitCounts counts = fit(grid, given_markers(list), {}, phi);
      EXPECT_GT(counts.quadratic + counts.mean, 5u);
      for(int j = 0; j <= 10; ++j)
        for(int i = 0; i <= 10; ++i)
          EXPECT_NEAR(phi[grid.node(i, j)], i == 0 ? 0 : 0.05, i == 0 ? 1e-10 : 0)
              << i << ' ' << j;
    }

    TEST(MarkerFit, ClustersNeedNormals)
    {
      SeedingParameters seeding;
      seeding.normals = false;
      const Grid grid = unit_grid(20);
      std::vector<double> phi(grid.size(), 0);
      EXPECT_THROW(fit(grid, seed_markers(grid, circle, seeding), {}, phi),
                   cases::InputError);
    }

    TEST(MarkerScheme, RefusesWhatMakesNoSense)
    {
      const Grid grid = unit_grid(20);
      MarkerParameters parameters;
      parameters.correct_every = 0;
      EXPECT_THROW(MarkerScheme(grid, parameters, "test"), cases::InputError);
      parameters = MarkerParameters::original();
      parameters.reseeding = ReseedingRule::midpoint;
      EXPECT_THROW(MarkerScheme(grid, parameters, "test"), cases::InputError);
      parameters = {};
      parameters.threads = 0;
      EXPECT_THROW(MarkerScheme(grid, parameters, "test"), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::level_set
