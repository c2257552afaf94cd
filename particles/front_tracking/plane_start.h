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
   * solution of each at the time at which the smallest has grown to a radius: the largest
   * one before walls or other sinks are felt.
   * @param smallest_seed, largest_seed bounds of that radius (m)
   * @throws cases::Refusal where none of these applies
   */
  PlaneStart find_plane_start(const cases::Scene &scene, double smallest_seed,
                              double largest_seed);
} // namespace meltfront::particles::front_tracking

#endif
