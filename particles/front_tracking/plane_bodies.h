#ifndef meltfront_particles_front_tracking_plane_bodies_h
#define meltfront_particles_front_tracking_plane_bodies_h

#include <particles/front_tracking/plane_contour.h>
#include <particles/front_tracking/plane_nodes.h>

#include <cstdint>
#include <vector>

namespace meltfront::particles::front_tracking
{
  /** A connected piece of one phase within the domain. */
  struct Body
  {
    bool solid = false;
    double area = 0; ///< m^2
    PlanePoint centre{0, 0};
  };

  /**
   * The bodies that are smaller than an area, also those cut off by walls, whose curves
   * go on beyond: connected sets of the nodes' samples on which a level set has one sign.
   */
  class SmallBodies
  {
  public:
    /** @param level_set negative in solid
     * @param least_area of a body that is not small (m^2) */
    SmallBodies(const PlaneNodes &nodes, const PlaneLevelSet &level_set,
                double least_area);

    const std::vector<Body> &bodies() const
    {
      return found;
    }

    /** The small body at a place within it or beyond the wall that it lies at; null
     * elsewhere. */
    const Body *at(const PlanePoint &place) const;

  private:
    void find(const PlaneLevelSet &level_set, double least_area);
    void spread_beyond_walls();

    const PlaneNodes &nodes;
    std::vector<Body> found;
    std::vector<std::uint32_t> body_of; ///< of samples, 1 + the number; 0: none
  };
} // namespace meltfront::particles::front_tracking

#endif
