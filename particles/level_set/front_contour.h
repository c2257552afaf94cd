#ifndef meltfront_particles_level_set_front_contour_h
#define meltfront_particles_level_set_front_contour_h

#include <particles/level_set/level_set.h>

namespace meltfront::particles::level_set
{
  /** A piece of a front in the plane: points in order, the phase with phi > 0 on the
   * left. */
  struct FrontLine
  {
    std::vector<Position> points; ///< m
    bool closed = false;          ///< the last is joined to the first
  };

  /** Where the front cuts the grid's edges, phi linear along each, in the order of the
   * grid (m). The work grows with the front. */
  std::vector<Position> front_points(const LevelSet &level_set);

  /**
   * The front in the plane as lines: marching squares, one point per cut edge; in a cell
   * that is cut on all four sides the value in the middle decides. Lines that are not
   * closed end on the border.
   *
   * @param spacing points closer than this to the one before are left out (m); 0: none
   * @throws cases::InputError in 3D
   */
  std::vector<FrontLine> front_lines(const LevelSet &level_set, double spacing = 0);
} // namespace meltfront::particles::level_set

#endif
