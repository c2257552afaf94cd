#include <particles/level_set/front_contour.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    Position cut_point(const LevelSet &level_set, std::size_t node, int direction)
    {
      const Grid &grid = level_set.grid();
      const double below = level_set.values()[node];
      const double above = level_set.values()[node + grid.stride(direction)];
      Position point = grid.position(node);
      point[direction] += grid.spacing() * below / (below - above);
      return point;
    }
  } // namespace

  std::vector<Position> front_points(const LevelSet &level_set)
  {
    const Grid &grid = level_set.grid();
    const double *phi = level_set.values().data();
    std::vector<Position> points;
    for(const NodeRun &run : level_set.band().runs())
      for(int n = 0; n < run.length; ++n)
        for(int d = 0; d < grid.dimension(); ++d)
        {
          const std::size_t node = run.node + n;
          const int index = run.index[d] + (d == 0 ? n : 0);
          if(index < grid.nodes(d) - 1
             && (phi[node] > 0) != (phi[node + grid.stride(d)] > 0))
            points.push_back(cut_point(level_set, node, d));
        }
    return points;
  }
} // namespace meltfront::particles::level_set
