#include <cases/error.h>
#include <particles/voronoi_fv/voronoi.h>

#include <fmt/format.h>
#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    constexpr double particles_per_block = 5; ///< at which voro++ is fastest
    constexpr double most_volume_defect = 1e-9;

    /** The box in units of the particles' mean spacing, for voro++ has tolerances of its
     * own that are absolute, and half a unit beyond 0 where there is no dimension. */
    class Frame
    {
    public:
      Frame(const ParticleStorage &particles, const CoordinateBox &box)
        : box(box)
      {
        double volume = 1;
        for(int d = 0; d < box.dimension; ++d)
          volume *= box.upper[d] - box.lower[d];
        const double count
            = static_cast<double>(std::max<std::size_t>(particles.size(), 1));
        unit = std::pow(volume / count, 1. / box.dimension);
        for(int d = 0; d < box.dimension; ++d)
          length[d] = (box.upper[d] - box.lower[d]) / unit;
      }

      double lower(int d) const
      {
        return d < box.dimension ? 0 : -0.5;
      }

      double upper(int d) const
      {
        return d < box.dimension ? length[d] : 0.5;
      }

      int blocks(int d) const
      {
        if(d >= box.dimension)
          return 1;
        const double side = std::pow(particles_per_block, 1. / box.dimension);
        return std::max(1, static_cast<int>(length[d] / side));
      }

      double inside(int d, double coordinate) const
      {
        const double scaled = (coordinate - box.lower[d]) / unit;
        if(!(scaled >= -1e-12 * length[d] && scaled <= length[d] * (1 + 1e-12)))
          throw cases::InputError(fmt::format(
              "a particle of a tessellation is at {} = {:.6g}, outside of the "
              "box from {:.6g} to {:.6g}",
              "xyz"[d], coordinate, box.lower[d], box.upper[d]));
        // voro++ takes a particle on the upper wall to be outside.
        return std::clamp(scaled, 0., length[d] * (1 - 1e-15));
      }

      double outside(int d, double scaled) const
      {
        return std::clamp(box.lower[d] + unit * scaled, box.lower[d], box.upper[d]);
      }

      double unit = 1; ///< m

    private:
      CoordinateBox box;
      std::array<double, 3> length{1, 1, 1};
    };

    /** Appends what voro++ says of a cell; a face stands there once from either side. */
    class CellReader
    {
    public:
      CellReader(VoronoiCells &cells, const Frame &frame, int dimension)
        : cells(cells)
        , frame(frame)
        , dimension(dimension)
        , area_unit(std::pow(frame.unit, dimension - 1))
        , volume_unit(std::pow(frame.unit, dimension))
      {
      }

      void read(voro::voronoicell_neighbor &cell, std::uint32_t number,
                const std::array<double, 3> &place)
      {
        cells.volumes[number] = volume_unit * cell.volume();
        std::array<double, 3> centre{};
        cell.centroid(centre[0], centre[1], centre[2]);
        for(int d = 0; d < dimension; ++d)
          cells.centroids.position[d][number] = frame.outside(d, place[d] + centre[d]);
        cell.neighbors(neighbours);
        cell.face_areas(areas);
        for(std::size_t f = 0; f < neighbours.size(); ++f)
          add_face(number, neighbours[f], area_unit * areas[f]);
      }

    private:
      void add_face(std::uint32_t number, int neighbour, double area)
      {
        if(neighbour >= 0)
        {
          const auto other = static_cast<std::uint32_t>(neighbour);
          cells.faces.push_back({std::min(number, other), std::max(number, other), area});
        }
        else if(-neighbour <= 2 * dimension)
          cells.walls.push_back(
              {number, static_cast<std::uint8_t>(-neighbour - 1), area});
      }

      VoronoiCells &cells;
      const Frame &frame;
      int dimension;
      double area_unit, volume_unit;
      std::vector<int> neighbours;
      std::vector<double> areas;
    };

    /** Join both sides' views of each face; one that only one side sees is next to none.
     */
    void join(std::vector<CellFace> &faces)
    {
      std::ranges::stable_sort(
          faces, [](const CellFace &a, const CellFace &b)
          { return std::pair(a.first, a.second) < std::pair(b.first, b.second); });
      std::size_t kept = 0;
      for(std::size_t f = 0; f < faces.size(); ++kept)
      {
        CellFace face = faces[f++];
        if(f < faces.size() && faces[f].first == face.first
           && faces[f].second == face.second)
          face.area += faces[f++].area;
        face.area *= 0.5;
        faces[kept] = face;
      }
      faces.resize(kept);
      std::erase_if(faces, [](const CellFace &face) { return !(face.area > 0); });
    }

    void check_volumes(const VoronoiCells &cells, const CoordinateBox &box)
    {
      double sum = 0, volume = 1;
      for(const double cell : cells.volumes)
        sum += cell;
      for(int d = 0; d < box.dimension; ++d)
        volume *= box.upper[d] - box.lower[d];
      if(!(std::abs(sum - volume) <= most_volume_defect * volume))
        throw cases::InputError(
            fmt::format("the Voronoi cells have a volume of {:.9g}, but their box has "
                        "{:.9g}: are two particles at the same place?",
                        sum, volume));
    }
  } // namespace

  VoronoiCells voronoi_cells(const ParticleStorage &particles, const CoordinateBox &box)
  {
    const Frame frame(particles, box);
    voro::container container(frame.lower(0), frame.upper(0), frame.lower(1),
                              frame.upper(1), frame.lower(2), frame.upper(2),
                              frame.blocks(0), frame.blocks(1), frame.blocks(2), false,
                              false, false, 8);
    for(std::size_t i = 0; i < particles.size(); ++i)
    {
      std::array<double, 3> place{};
      for(int d = 0; d < box.dimension; ++d)
        place[d] = frame.inside(d, particles.position[d][i]);
      container.put(static_cast<int>(i), place[0], place[1], place[2]);
    }
    VoronoiCells cells;
    cells.volumes.assign(particles.size(), 0.);
    cells.centroids = particles;
    CellReader reader(cells, frame, box.dimension);
    voro::c_loop_all loop(container);
    voro::voronoicell_neighbor cell;
    if(loop.start())
      do
        if(container.compute_cell(cell, loop))
        {
          std::array<double, 3> place{};
          loop.pos(place[0], place[1], place[2]);
          reader.read(cell, static_cast<std::uint32_t>(loop.pid()), place);
        }
      while(loop.inc());
    join(cells.faces);
    std::ranges::stable_sort(cells.walls, {}, &CellWall::cell);
    check_volumes(cells, box);
    return cells;
  }

  void lloyd(ParticleStorage &particles, std::span<const std::uint32_t> movable,
             const CoordinateBox &box, int sweeps)
  {
    for(int sweep = 0; sweep < sweeps; ++sweep)
    {
      const VoronoiCells cells = voronoi_cells(particles, box);
      for(int d = 0; d < box.dimension; ++d)
        for(const std::uint32_t i : movable)
          particles.position[d][i] = cells.centroids.position[d][i];
    }
  }
} // namespace meltfront::particles
