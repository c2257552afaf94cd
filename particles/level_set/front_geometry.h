#ifndef meltfront_particles_level_set_front_geometry_h
#define meltfront_particles_level_set_front_geometry_h

#include <particles/level_set/level_set.h>

namespace meltfront::particles::level_set
{
  /** Unit normal out of the phase with phi > 0, -grad phi/|grad phi|, at a point near the
   * front; zero where phi has no slope. Second order. */
  Position outward_normal(const LevelSet &level_set, const Position &point);

  /**
   * Curvature of the contour of phi through a node, -div(grad phi/|grad phi|) by central
   * differences: 1/R for a disk of the phase with phi > 0, 2/R for a ball (1/m). Zero
   * where phi has no slope. Nodes on the border take the curvature next to it.
   */
  double node_curvature(const LevelSet &level_set, std::array<int, 3> index);

  /** The same at a point, interpolated between the nodes. Second order if phi is a
   * distance; differentiate after reinitialisation only. */
  double curvature(const LevelSet &level_set, const Position &point);
} // namespace meltfront::particles::level_set

#endif
