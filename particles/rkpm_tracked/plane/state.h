#ifndef meltfront_particles_rkpm_tracked_plane_state_h
#define meltfront_particles_rkpm_tracked_plane_state_h

#include <particles/rkpm_tracked/plane/stencils.h>

#include <array>
#include <memory>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  inline constexpr int n_phases = 2;

  /** Number of a phase in arrays. */
  inline constexpr std::size_t index_of(NodePhase phase)
  {
    return phase == NodePhase::solid ? 1 : 0;
  }

  /** A phase's unknown about the front particles, to second order. */
  struct FrontExpansion
  {
    std::vector<double> value;
    std::vector<PlanePoint> gradient;
    std::vector<Eigen::Vector3d> second; ///< xx, xy, yy

    double at(std::size_t particle, const PlanePoint &offset) const
    {
      return value[particle] + gradient[particle].dot(offset)
             + (second[particle][0] * offset.x() * offset.x()
                + second[particle][2] * offset.y() * offset.y())
                   / 2
             + second[particle][1] * offset.x() * offset.y();
    }

    PlanePoint gradient_at(std::size_t particle, const PlanePoint &offset) const
    {
      const Eigen::Vector3d &h = second[particle];
      return gradient[particle]
             + PlanePoint(h[0] * offset.x() + h[1] * offset.y(),
                          h[1] * offset.x() + h[2] * offset.y());
    }

    double second_along(std::size_t particle, const PlanePoint &direction) const
    {
      const Eigen::Vector3d &h = second[particle];
      return h[0] * direction.x() * direction.x() + h[2] * direction.y() * direction.y()
             + 2 * h[1] * direction.x() * direction.y();
    }
  };

  /**
   * The state at a time. The unknown of a node is the temperature in the liquid, the
   * temperature less the sinks' singular part in the solid.
   */
  struct PlaneState
  {
    PlaneState() = default;
    PlaneState(PlaneState &&) = default;
    PlaneState &operator=(PlaneState &&) = default;

    double time = 0;
    PlaneFront front;
    std::vector<NodePhase> phase;
    std::vector<double> unknown;
    std::array<FrontExpansion, n_phases> expansion; ///< by index_of(phase)
    std::vector<PlanePoint> expanded_about; ///< places of the front particles that they
                                            ///< are expansions about
    /** Heat that has come in through walls, without that of fluxes that vary: by the
     * formula in time that the temperatures have (J/m). */
    double wall_heat = 0;
    double flux_heat = 0;     ///< of fluxes that vary (J/m)
    double released_heat = 0; ///< throughout the domain (J/m)
    double multiplier = 0;    ///< of the heat balance in the last step
    PlaneBins expansion_bins; ///< of expanded_about

    /** The unknown of a phase at a place, also beyond the front: there by the expansion
     * about the nearest front particle. */
    double extended(NodePhase wanted, std::size_t node, const PlanePoint &place) const
    {
      if(phase[node] == wanted)
        return unknown[node];
      const long nearest = expansion_bins.nearest(place);
      if(nearest < 0)
        return unknown[node];
      return expansion[index_of(wanted)].at(nearest, place - expanded_about[nearest]);
    }
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
