#ifndef meltfront_particles_rkpm_tracked_plane_heat_correction_h
#define meltfront_particles_rkpm_tracked_plane_heat_correction_h

#include <particles/rkpm_tracked/plane/heat.h>

namespace meltfront::particles::rkpm_tracked
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
   * @return the heat that is made up for by that (J/m); none without an active particle
   */
  double close_budget(const cases::Scene &scene, const PlaneSinks &sinks,
                      const PlaneFront &before, PlaneState &state, double missing,
                      double farthest);
  /** Warm all nodes alike by the missing heat, where there is no front to take it: the
   * mean temperature is then right, gradients stay.
   * @return the missing heat (J/m) */
  double warm_nodes(const cases::Scene &scene, const PlaneNodes &nodes, PlaneState &state,
                    double missing);
} // namespace meltfront::particles::rkpm_tracked

#endif
