#include <cases/error.h>
#include <particles/voronoi_fv/voronoi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace meltfront::particles
{
  namespace
  {
    const CoordinateBox box{3, {-1, 2, 0}, {2, 4, 1}};

    CoordinateBox box_in(int dimension)
    {
      CoordinateBox result = box;
      result.dimension = dimension;
      return result;
    }

    double volume(const CoordinateBox &b)
    {
      double result = 1;
      for(int d = 0; d < b.dimension; ++d)
        result *= b.upper[d] - b.lower[d];
      return result;
    }

    ParticleStorage random_particles(const CoordinateBox &b, int count, double scale = 1)
    {
      std::mt19937_64 generator(11);
      ParticleStorage result{b.dimension, {}};
      for(int i = 0; i < count; ++i)
      {
        std::array<double, 3> point{};
        for(int d = 0; d < b.dimension; ++d)
          point[d] = scale
                     * (b.lower[d]
                        + (b.upper[d] - b.lower[d]) * static_cast<double>(generator())
                              * 0x1p-64);
        result.add(point);
      }
      return result;
    }

    TEST(Voronoi, VolumesAddUpAndFacesClose)
    {
      for(int dimension = 1; dimension <= 3; ++dimension)
        // Coordinates of any size are as good.
        for(const double scale : {1., 1e-4, 1e5})
        {
          CoordinateBox b = box_in(dimension);
          const ParticleStorage particles = random_particles(b, 400, scale);
          for(int d = 0; d < dimension; ++d)
          {
            b.lower[d] *= scale;
            b.upper[d] *= scale;
          }
          const VoronoiCells cells = voronoi_cells(particles, b);
          EXPECT_NEAR(std::accumulate(cells.volumes.begin(), cells.volumes.end(), 0.)
                          / volume(b),
                      1, 1e-12)
              << dimension;
          // Each cell is closed: areas times outward normals add up to zero.
          std::vector<std::array<double, 3>> sum(particles.size());
          double largest = 0;
          for(const CellFace &face : cells.faces)
          {
            const auto p = particles.point(face.first), q = particles.point(face.second);
            const double distance = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
            largest = std::max(largest, face.area);
            for(int d = 0; d < dimension; ++d)
            {
              sum[face.first][d] += face.area * (q[d] - p[d]) / distance;
              sum[face.second][d] -= face.area * (q[d] - p[d]) / distance;
            }
          }
          for(const CellWall &wall : cells.walls)
            sum[wall.cell][wall.side / 2] += wall.side % 2 == 1 ? wall.area : -wall.area;
          for(const auto &cell : sum)
            for(int d = 0; d < dimension; ++d)
              ASSERT_NEAR(cell[d] / largest, 0, 1e-9) << dimension;
        }
    }

    TEST(Voronoi, ALatticeHasItsCellsWallsAndCentroids)
    {
      ParticleStorage particles{2, {}};
      constexpr int n = 10;
      for(int j = 0; j <= n; ++j)
        for(int i = 0; i <= n; ++i)
          particles.add({i / double(n), j / double(n), 0});
      const VoronoiCells cells = voronoi_cells(particles, {2, {0, 0, 0}, {1, 1, 1}});
      double wall_area = 0;
      for(const CellWall &wall : cells.walls)
      {
        const auto p = particles.point(wall.cell);
        EXPECT_EQ(p[wall.side / 2], wall.side % 2);
        wall_area += wall.area;
      }
      EXPECT_NEAR(wall_area, 4, 1e-12);
      for(std::size_t i = 0; i < particles.size(); ++i)
      {
        const auto p = particles.point(i);
        double expected = 0.01;
        for(int d = 0; d < 2; ++d)
        {
          const bool at_wall = p[d] == 0 || p[d] == 1;
          expected *= at_wall ? 0.5 : 1;
          EXPECT_NEAR(cells.centroids.position[d][i],
                      p[d]
                          + (p[d] == 0   ? 0.025
                             : p[d] == 1 ? -0.025
                                         : 0),
                      1e-12);
        }
        EXPECT_NEAR(cells.volumes[i], expected, 1e-13);
      }
      for(const CellFace &face : cells.faces)
      {
        const auto p = particles.point(face.first), q = particles.point(face.second);
        const double distance = std::hypot(p[0] - q[0], p[1] - q[1]);
        // Across a corner cells meet in a point at most.
        if(distance > 0.11)
          EXPECT_LT(face.area, 1e-9);
        else
          EXPECT_NEAR(face.area,
                      (p[0] == q[0] && (p[0] == 0 || p[0] == 1))
                              || (p[1] == q[1] && (p[1] == 0 || p[1] == 1))
                          ? 0.05
                          : 0.1,
                      1e-12);
      }
    }

    TEST(Voronoi, InOneDimensionCellsEndMidway)
    {
      const ParticleStorage particles{1, {{{0, 0.3, 0.7, 1}, {}, {}}}};
      const VoronoiCells cells = voronoi_cells(particles, {1, {0, 0, 0}, {1, 1, 1}});
      const std::vector<double> expected{0.15, 0.35, 0.35, 0.15};
      for(int i = 0; i < 4; ++i)
        EXPECT_NEAR(cells.volumes[i], expected[i], 1e-13);
      ASSERT_EQ(cells.faces.size(), 3);
      for(const CellFace &face : cells.faces)
      {
        EXPECT_EQ(face.second, face.first + 1);
        EXPECT_NEAR(face.area, 1, 1e-13);
      }
      ASSERT_EQ(cells.walls.size(), 2);
    }

    TEST(Voronoi, LloydBringsParticlesToTheCentroids)
    {
      const CoordinateBox b = box_in(2);
      ParticleStorage particles = random_particles(b, 100);
      const ParticleStorage start = particles;
      std::vector<std::uint32_t> movable(90);
      std::iota(movable.begin(), movable.end(), 10U);
      const auto distance = [&](const ParticleStorage &at)
      {
        const VoronoiCells cells = voronoi_cells(at, b);
        double sum = 0;
        for(const std::uint32_t i : movable)
          sum += std::hypot(cells.centroids.position[0][i] - at.position[0][i],
                            cells.centroids.position[1][i] - at.position[1][i]);
        return sum;
      };
      const double before = distance(particles);
      lloyd(particles, movable, b, 30);
      EXPECT_LT(distance(particles), 0.05 * before);
      for(int i = 0; i < 10; ++i)
        EXPECT_EQ(particles.point(i), start.point(i));
    }

    TEST(Voronoi, RefusesWhatCannotBeTessellated)
    {
      const CoordinateBox unit{2, {0, 0, 0}, {1, 1, 1}};
      const ParticleStorage outside{2, {{{0.5, 1.5}, {0.5, 0.5}, {}}}};
      EXPECT_THROW(voronoi_cells(outside, unit), cases::InputError);
      const ParticleStorage twins{2, {{{0.5, 0.5, 0.2}, {0.5, 0.5, 0.2}, {}}}};
      EXPECT_THROW(voronoi_cells(twins, unit), cases::InputError);
      EXPECT_THROW(voronoi_cells({2, {}}, unit), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles
