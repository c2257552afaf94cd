#ifndef meltfront_particles_level_set_tests_shapes_h
#define meltfront_particles_level_set_tests_shapes_h

#include <cases/shape.h>
#include <particles/level_set/level_set.h>

namespace meltfront::particles::level_set
{
  /** A square or cube of unit side. */
  inline Grid unit_grid(int cells, int dimension = 2)
  {
    return {dimension, {0, 0, 0}, 1. / cells, {cells, cells, cells}};
  }

  inline const cases::Ball disk(2, {0.5, 0.75, 0}, 0.15);

  inline const cases::Ball ball(3, {0.35, 0.35, 0.35}, 0.15);

  /** Zalesak's disk. */
  inline const cases::SlottedDisk slotted_disk({0.5, 0.75, 0}, 0.15, 0.05, 0.25);

  /** The disk in the plane, the ball in space. */
  inline const cases::Ball &round_shape(int dimension)
  {
    return dimension == 2 ? disk : ball;
  }

  /** Out of the disk or the ball. */
  inline Position outwards(const Position &point, int dimension)
  {
    const Position centre
        = dimension == 2 ? Position{0.5, 0.75, 0} : Position{0.35, 0.35, 0.35};
    Position normal{};
    for(int d = 0; d < dimension; ++d)
      normal[d] = point[d] - centre[d];
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for(double &component : normal)
      component /= length;
    return normal;
  }

  template <typename Shape>
  ScalarFunction distance_from(const Shape &shape)
  {
    return [shape](const Position &p) { return shape.signed_distance(p); };
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
