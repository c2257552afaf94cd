#ifndef meltfront_particles_front_tracking_plane_closure_h
#define meltfront_particles_front_tracking_plane_closure_h

#include <particles/front_tracking/plane_heat.h>

namespace meltfront::particles::front_tracking
{
  /** Whether all heat that comes in through the walls is given, or none comes. */
  bool wall_heat_is_given(const cases::Scene &scene);

  /**
   * Move the front by what the heat budget lacks: collocation conserves no heat, and what
   * it lost is missing from what melts or freezes. The missing heat is shared out among
   * the particles in proportion to the heat that flows to them from both sides,
   * k_s |dT_s/dn| + k_l |dT_l/dn|: each flow is wrong by the same part.
   *
   * @param state its expansions are those of its front
   * @param before the front at the last state: no particle goes farther for the budget
   * than by half of its way from there, so that none turns back
   * @param missing heat by which the state's budget is short (J/m)
   * @param farthest no particle goes farther (m)
   * @return the heat that is made up for by that (J/m)
   */
  double close_budget(const cases::Scene &scene, const PlaneSinks &sinks,
                      const PlaneFront &before, PlaneState &state, double missing,
                      double farthest);
} // namespace meltfront::particles::front_tracking

#endif
