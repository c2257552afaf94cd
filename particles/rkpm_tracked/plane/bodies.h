#ifndef meltfront_particles_rkpm_tracked_plane_bodies_h
#define meltfront_particles_rkpm_tracked_plane_bodies_h

#include <particles/rkpm_tracked/plane/contour.h>
#include <particles/rkpm_tracked/plane/nodes.h>

#include <cstdint>
#include <vector>

namespace meltfront::particles::rkpm_tracked
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
   * go on beyond: sets of the nodes' samples on which a level set has one sign, connected
   * across gaps of up to half a spacing, so that a film's pieces between samples are one.
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

    /** Whether all samples are solid, or liquid. */
    bool all(bool solid) const
    {
      return solid ? n_liquid == 0 : n_solid == 0;
    }

    /** The small body at a place within it or beyond the wall that it lies at; null
     * elsewhere. */
    const Body *at(const PlanePoint &place) const;

  private:
    void find(const PlaneLevelSet &level_set, double least_area);
    void spread_beyond_walls();

    const PlaneNodes &nodes;
    std::size_t n_solid = 0, n_liquid = 0; ///< samples
    std::vector<Body> found;
    std::vector<std::uint32_t> body_of; ///< of samples, 1 + the number; 0: none
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
