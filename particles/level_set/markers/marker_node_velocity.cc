#include <particles/level_set/markers/marker_node_velocity.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    CellPlace place_of(const Grid &grid, const cases::PointArrays &points, std::size_t p)
    {
      Position at{};
      for(int d = 0; d < grid.dimension(); ++d)
        at[d] = points[d][p];
      return grid.locate(at);
    }
  } // namespace

  NodeVelocity::NodeVelocity(const Grid &grid)
    : grid(grid)
  {
    for(int d = 0; d < grid.dimension(); ++d)
      values[d].assign(grid.size(), 0);
  }

  std::string NodeVelocity::description() const
  {
    return "velocity given at the nodes of a grid";
  }

  void NodeVelocity::velocities(const cases::PointArrays &points, double,
                                const std::array<std::span<double>, 3> &velocity) const
  {
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      const CellPlace place = place_of(grid, points, p);
      for(int d = 0; d < grid.dimension(); ++d)
        velocity[d][p] = interpolate(grid, values[d].data(), place);
    }
  }

  void NodeVelocity::gradients(const cases::PointArrays &points, double,
                               const std::array<std::span<double>, 9> &gradient) const
  {
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      const CellPlace place = place_of(grid, points, p);
      for(int i = 0; i < grid.dimension(); ++i)
      {
        const Position slope = interpolate_gradient(grid, values[i].data(), place);
        for(int j = 0; j < grid.dimension(); ++j)
          gradient[3 * i + j][p] = slope[j];
      }
    }
  }
} // namespace meltfront::particles::level_set
