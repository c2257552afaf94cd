#ifndef meltfront_particles_rkpm_tracked_plane_topology_h
#define meltfront_particles_rkpm_tracked_plane_topology_h

#include <particles/rkpm_tracked/plane/heat.h>
#include <particles/rkpm_tracked/plane/marked_front.h>

#include <string>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** Something that changed how the front's curves are connected. */
  struct TopologyEvent
  {
    std::string what;      ///< one clause
    bool vanished = false; ///< a curve went; else curves met
  };

  /** How curves meet and go. */
  struct TopologySettings
  {
    double spacing = 0;         ///< of the nodes (m)
    double front_spacing = 0;   ///< of the front's particles (m)
    double least_radius = 0.35; ///< of a curve, in spacings: below it goes
    bool join = true;           ///< whether curves may meet
  };

  /** Square root of a curve's area over pi (m). */
  double curve_radius(const PlaneFront &front, std::size_t curve);

  /**
   * Take out curves that enclose almost nothing or lie beyond the walls; where the level
   * set connects otherwise than the curves, lay them anew along its zeros.
   *
   * The particles of a curve and the zero contour nearest to them belong together; as
   * long as that pairs the two one by one, both connect alike. Order and number of new
   * curves come from the contours, never from what they were.
   *
   * @return what happened; if anything did, speeds are those of the nearest particles of
   * before and displacements are zero; the level set is to be seeded anew
   */
  std::vector<TopologyEvent> update_topology(PlaneFront &front, const PlaneNodes &nodes,
                                             const MarkedFront &marked,
                                             bool &solid_beyond,
                                             const TopologySettings &settings);

  /** Move the particles near some places along their normals so that an area of solid
   * is added (m^2), none by more than a tenth of a spacing. */
  void add_solid(PlaneFront &front, const std::vector<PlanePoint> &places, double area,
                 double spacing);

  /** Longest step in which no two pieces of the front that face each other lose more than
   * half of the gap between them, or a tenth of a spacing, at their speeds (s). */
  double longest_step_of_films(const PlaneFront &front, const TopologySettings &settings);

  /**
   * Take the heat by which areas that changed their phase by decree changed that of a
   * state out of the nodes about them: their temperatures approach the melting
   * temperature, the nearest nodes', and those of no more nodes than it takes, so that
   * none is changed by more than half its distance from it. What these have not all
   * others take alike, which go farther from the melting temperature by it. Nodes whose
   * area the front may cut are left out: there the expansions about the front tell the
   * heat.
   * @param places where it was; none: all nodes approach by the same share
   * @param wanted heat of the state, as measure() finds it (J/m)
   * @return the heat that is missing afterwards, round-off unless no node is left (J/m)
   */
  double book_heat(PlaneState &state, const cases::Scene &scene, const PlaneNodes &nodes,
                   PlaneHeat &heat, const std::vector<PlanePoint> &places, double wanted);
} // namespace meltfront::particles::rkpm_tracked

#endif
