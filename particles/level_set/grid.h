#ifndef meltfront_particles_level_set_grid_h
#define meltfront_particles_level_set_grid_h

#include <cases/position.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace meltfront::particles::level_set
{
  using cases::Position;

  /** A cell of a grid and where in it a point lies. */
  struct CellPlace
  {
    std::size_t node = 0;             ///< the cell's node of lowest coordinates
    std::array<double, 3> local = {}; ///< coordinates over the spacing, 0 to 1 inside
  };

  /**
   * A lattice of nodes with one spacing in two or three dimensions, three layers of ghost
   * nodes around it. Nodes are numbered along x, then y, then z, ghosts included; values
   * at nodes are arrays of size(). In 2D there is one plane of nodes, z = 0.
   *
   * @code
   * const Grid grid(2, {0, 0, 0}, 1. / 80, {80, 80, 0}); // the unit square
   * @endcode
   */
  class Grid
  {
  public:
    static constexpr int ghost_layers = 3;

    /**
     * @param dimension 2 or 3
     * @param origin the node of lowest coordinates (m)
     * @param spacing of the nodes (m)
     * @param cells along each coordinate, at least 4; those beyond the dimension are
     * ignored
     * @throws cases::InputError for numbers that give no grid
     */
    Grid(int dimension, const Position &origin, double spacing,
         const std::array<int, 3> &cells);

    int dimension() const
    {
      return dimensions;
    }

    double spacing() const
    {
      return distance;
    }

    const Position &origin() const
    {
      return lowest;
    }

    /** Nodes along a coordinate, without ghosts; 1 beyond the dimension. */
    int nodes(int direction) const
    {
      return counts[direction];
    }

    /** Cells along a coordinate; 1 beyond the dimension. */
    int cells(int direction) const
    {
      return std::max(counts[direction] - 1, 1);
    }

    /** Step in node numbers along a coordinate. */
    std::ptrdiff_t stride(int direction) const
    {
      return strides[direction];
    }

    /** Nodes and ghosts. */
    std::size_t size() const
    {
      return total;
    }

    /** Number of a node; ghosts have indices below zero or beyond the count. */
    std::size_t node(int i, int j, int k = 0) const
    {
      return static_cast<std::size_t>(first + i + j * strides[1] + k * strides[2]);
    }

    std::size_t node(const std::array<int, 3> &index) const
    {
      return node(index[0], index[1], index[2]);
    }

    /** Indices of a node from its number. */
    std::array<int, 3> indices(std::size_t node) const
    {
      const int margin = dimensions == 3 ? ghost_layers : 0;
      const auto number = static_cast<std::ptrdiff_t>(node);
      return {static_cast<int>(number % strides[1]) - ghost_layers,
              static_cast<int>(number % strides[2] / strides[1]) - ghost_layers,
              static_cast<int>(number / strides[2]) - margin};
    }

    double coordinate(int direction, int index) const
    {
      return lowest[direction] + index * distance;
    }

    Position position(const std::array<int, 3> &index) const
    {
      return {coordinate(0, index[0]), coordinate(1, index[1]),
              dimensions == 3 ? coordinate(2, index[2]) : 0.};
    }

    Position position(std::size_t node) const
    {
      return position(indices(node));
    }

    /** Whether a point lies in the grid, borders included. */
    bool contains(const Position &point) const;

    /** The cell of a point; for points outside the nearest one, with local coordinates
     * beyond 0 to 1. */
    CellPlace locate(const Position &point) const
    {
      CellPlace place;
      std::ptrdiff_t node = first;
      for(int d = 0; d < dimensions; ++d)
      {
        const double scaled = (point[d] - lowest[d]) / distance;
        const double last = counts[d] - 2;
        // also right for what is not a number
        const int index = scaled > 0 ? static_cast<int>(std::min(scaled, last)) : 0;
        node += index * strides[d];
        place.local[d] = scaled - index;
      }
      place.node = static_cast<std::size_t>(node);
      return place;
    }

  private:
    int dimensions;
    Position lowest;
    double distance;
    std::array<int, 3> counts{1, 1, 1};
    std::array<std::ptrdiff_t, 3> strides{1, 0, 0};
    std::ptrdiff_t first = 0; ///< number of the node of lowest coordinates
    std::size_t total = 0;
  };

  /** The value at a place by bilinear or trilinear interpolation. */
  inline double interpolate(const Grid &grid, const double *values,
                            const CellPlace &place)
  {
    const double x = place.local[0], y = place.local[1];
    const std::ptrdiff_t up = grid.stride(1);
    const auto plane = [&](const double *corner)
    {
      return (1 - y) * ((1 - x) * corner[0] + x * corner[1])
             + y * ((1 - x) * corner[up] + x * corner[up + 1]);
    };
    const double *corner = values + place.node;
    if(grid.dimension() == 2)
      return plane(corner);
    return (1 - place.local[2]) * plane(corner)
           + place.local[2] * plane(corner + grid.stride(2));
  }

  /** The same of the nodes' central differences: a gradient that is continuous. */
  inline Position interpolate_gradient(const Grid &grid, const double *values,
                                       const CellPlace &place)
  {
    Position gradient{};
    for(int d = 0; d < grid.dimension(); ++d)
    {
      const std::ptrdiff_t step = grid.stride(d);
      gradient[d] = (interpolate(grid, values + step, place)
                     - interpolate(grid, values - step, place))
                    / (2 * grid.spacing());
    }
    return gradient;
  }
} // namespace meltfront::particles::level_set

#endif
