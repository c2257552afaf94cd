#ifndef meltfront_particles_level_set_front_contour_h
#define meltfront_particles_level_set_front_contour_h

#include <particles/level_set/level_set.h>

namespace meltfront::particles::level_set
{
  /** Where the front cuts the grid's edges, phi linear along each, in the order of the
   * grid (m). The work grows with the front. */
  std::vector<Position> front_points(const LevelSet &level_set);
} // namespace meltfront::particles::level_set

#endif
