#ifndef meltfront_reference_fem_cut_start_h
#define meltfront_reference_fem_cut_start_h

#include <reference_fem/cut/level_set.h>

#include <string>

namespace meltfront::reference_fem::cut
{
  /** A state with a front, from which a run may start. */
  struct Start
  {
    double time = 0;         ///< s; after the scene's start where the front was seeded
    PointFunction level_set; ///< negative in the solid; only sign and zeros matter
    PointFunction temperature;
    std::string description; ///< how the front was found, in words
  };

  /**
   * The front of a scene's initial state: its exact solution's, the level set that the
   * scene gives, or the zeros of T - T_m. A uniform liquid around line sinks is seeded
   * with the similarity solution of each (cases::LineSink) at the time when the smallest
   * front has a radius of `seed_cells` cells; the sinks and the walls must be so far away
   * from each other that they do not feel each other until then.
   *
   * @throws cases::Refusal where there is no front
   */
  Start find_start(const cases::Scene &scene, double spacing, double seed_cells);
} // namespace meltfront::reference_fem::cut

#endif
