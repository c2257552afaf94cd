#ifndef meltfront_particles_level_set_tests_shapes_h
#define meltfront_particles_level_set_tests_shapes_h

#include <particles/level_set/exact_fronts.h>
#include <particles/level_set/level_set.h>

namespace meltfront::particles::level_set
{
  inline Grid unit_grid(int cells, int dimension = 2)
  {
    return {dimension, {0, 0, 0}, 1. / cells, {cells, cells, cells}};
  }

  inline const Ball disk{2, {0.5, 0.75, 0}, 0.15};

  inline const Ball ball{3, {0.35, 0.35, 0.35}, 0.15};

  /** phi of anything that has a distance. */
  template <typename Shape>
  ScalarFunction distance_from(const Shape &shape)
  {
    return [shape](const Position &p) { return shape.distance(p); };
  }

  /** Call f(node, point) for all nodes of a band. */
  template <typename Function>
  void for_each_node(const Grid &grid, const Band &band, const Function &f)
  {
    for(const NodeRun &run : band.runs())
      for(int n = 0; n < run.length; ++n)
        f(run.node + n, grid.position({run.index[0] + n, run.index[1], run.index[2]}));
  }
} // namespace meltfront::particles::level_set

#endif
