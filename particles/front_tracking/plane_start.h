#ifndef meltfront_particles_front_tracking_plane_start_h
#define meltfront_particles_front_tracking_plane_start_h

#include <cases/scene.h>
#include <particles/front_tracking/plane_contour.h>

#include <functional>
#include <string>

namespace meltfront::particles::front_tracking
{
  /** What a run starts from. */
  struct PlaneStart
  {
    double time = 0; ///< after the scene's start where a front is seeded
    PlaneLevelSet level_set;
    std::function<double(const PlanePoint &)> temperature;
    std::string description;
  };

  /**
   * The exact solution's front, the scene's level set, where the initial temperature is
   * the melting temperature, or, around sinks in a uniform liquid, the similarity
   * solution of each at the time at which the smallest has grown to a radius.
   * @param seed_radius of that solution (m)
   * @throws cases::Refusal where none of these applies
   */
  PlaneStart find_plane_start(const cases::Scene &scene, double seed_radius);
} // namespace meltfront::particles::front_tracking

#endif
