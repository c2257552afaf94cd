#ifndef meltfront_particles_sph_wall_areas_h
#define meltfront_particles_sph_wall_areas_h

#include <particles/sph/conduction_rows.h>
#include <particles/sph/discretisation.h>

#include <vector>

namespace meltfront::particles
{
  /** What particles take from walls: an area of each (m^(d-1)), where on it, and of those
   * that exchange heat the depth behind it by link (m). */
  struct WallShares
  {
    std::vector<WallPoint> &points;
    std::vector<WallLink> &links; ///< to a point of its own each, of walls that bend
    std::vector<double> *depths = nullptr;

    /** Take an area in equal parts at several places. */
    void divide(std::size_t link, const std::vector<cases::Position> &places);
  };

  /**
   * Let the areas add up to each wall: what is computed from a kernel or from a body's
   * irregular edge does so nearly only. Around circles whose values vary the places move
   * along the wall to arcs that are as long as the areas and cover it in the same order,
   * so that what varies or jumps along it comes in with its integral.
   */
  void share_walls(const Discretisation &discretisation, WallShares shares);
} // namespace meltfront::particles

#endif
