#ifndef meltfront_particles_front_tracking_plane_topology_h
#define meltfront_particles_front_tracking_plane_topology_h

#include <particles/front_tracking/plane_heat.h>

#include <string>
#include <vector>

namespace meltfront::particles::front_tracking
{
  /** Something that changed how the front's curves are connected. */
  struct TopologyEvent
  {
    std::string what; ///< one clause
    PlanePoint place{0, 0};
    double solid_area = 0; ///< that appeared, negative where it went (m^2)
    bool vanished = false; ///< a curve went; else curves met
  };

  /** How curves meet and go. */
  struct TopologySettings
  {
    double spacing = 0;         ///< of the nodes (m)
    double front_spacing = 0;   ///< of the front's particles (m)
    double meeting_gap = 0.2;   ///< at which curves become one, in spacings
    double least_radius = 0.35; ///< of a curve, in spacings: below it goes
    bool join = true;           ///< whether curves may meet
  };

  /** Square root of a curve's area over pi (m). */
  double curve_radius(const PlaneFront &front, std::size_t curve);

  /**
   * Take out curves that enclose almost nothing or lie beyond the walls, and join those
   * that face each other across a gap of almost nothing.
   *
   * Curves that meet become the zeros of a level set: the distance to them, with bridges
   * across the gaps. Order and number of the curves come from its contours, never from
   * what they were.
   *
   * @return what happened; if anything did, speeds are those of the nearest particles of
   * before, and displacements are zero
   */
  std::vector<TopologyEvent> update_topology(PlaneFront &front, const PlaneNodes &nodes,
                                             bool &solid_beyond,
                                             const TopologySettings &settings);

  /**
   * Take the latent heat of an area that changed its phase by decree out of the nodes
   * about it: their temperatures approach the melting temperature, the nearest nodes',
   * and those of no more nodes than it takes, so that none is changed by more than half
   * its distance from it.
   * @param energy that is to be added to the nodes (J/m)
   * @return the part of it that was (J/m)
   */
  double book_latent_heat(PlaneState &state, const cases::Scene &scene,
                          const PlaneNodes &nodes, const PlaneHeat &heat,
                          const PlanePoint &place, double energy);
} // namespace meltfront::particles::front_tracking

#endif
