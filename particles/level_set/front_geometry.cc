#include <particles/level_set/front_geometry.h>

namespace meltfront::particles::level_set
{
  Position outward_normal(const LevelSet &level_set, const Position &point)
  {
    Position normal = level_set.gradient(point);
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if(!(length > 0))
      return {};
    for(double &component : normal)
      component /= -length;
    return normal;
  }

  double node_curvature(const LevelSet &level_set, std::array<int, 3> index)
  {
    const Grid &grid = level_set.grid();
    const int dimension = grid.dimension();
    for(int d = 0; d < dimension; ++d)
      index[d] = std::clamp(index[d], 1, grid.nodes(d) - 2);
    const double *phi = level_set.values().data() + grid.node(index);
    // differences times the spacing and its square: the sum is a curvature times it
    Position slope{};
    std::array<double, 3> second{};
    double squares = 0, laplacian = 0, along = 0;
    for(int d = 0; d < dimension; ++d)
    {
      const std::ptrdiff_t step = grid.stride(d);
      slope[d] = (phi[step] - phi[-step]) / 2;
      second[d] = phi[step] - 2 * phi[0] + phi[-step];
      squares += slope[d] * slope[d];
      laplacian += second[d];
      along += slope[d] * slope[d] * second[d];
    }
    if(!(squares > 0))
      return 0;
    for(int d = 0; d < dimension; ++d)
      for(int e = d + 1; e < dimension; ++e)
      {
        const std::ptrdiff_t p = grid.stride(d), q = grid.stride(e);
        const double mixed = (phi[p + q] - phi[p - q] - phi[q - p] + phi[-p - q]) / 4;
        along += 2 * slope[d] * slope[e] * mixed;
      }
    return -(laplacian * squares - along) / (squares * std::sqrt(squares))
           / grid.spacing();
  }

  double curvature(const LevelSet &level_set, const Position &point)
  {
    const Grid &grid = level_set.grid();
    const CellPlace place = grid.locate(point);
    const std::array<int, 3> lowest = grid.indices(place.node);
    double sum = 0;
    for(int corner = 0; corner < 1 << grid.dimension(); ++corner)
    {
      std::array<int, 3> index = lowest;
      double weight = 1;
      for(int d = 0; d < grid.dimension(); ++d)
      {
        const bool upper = corner >> d & 1;
        index[d] += upper;
        weight *= upper ? place.local[d] : 1 - place.local[d];
      }
      sum += weight * node_curvature(level_set, index);
    }
    return sum;
  }
} // namespace meltfront::particles::level_set
