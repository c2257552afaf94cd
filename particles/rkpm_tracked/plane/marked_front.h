#ifndef meltfront_particles_rkpm_tracked_plane_marked_front_h
#define meltfront_particles_rkpm_tracked_plane_marked_front_h

#include <particles/level_set/advection.h>
#include <particles/level_set/markers/marker_node_velocity.h>
#include <particles/level_set/markers/marker_scheme.h>
#include <particles/level_set/reinitialisation.h>
#include <particles/rkpm_tracked/plane/contour.h>
#include <particles/rkpm_tracked/plane/nodes.h>

#include <memory>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /**
   * The front a second time, as a level set with markers (the interpolative scheme of
   * SAND2016-9800, section 4.2.5) on a grid finer than the nodes: phi > 0 in liquid. It
   * moves by the way that the front's particles went, carried off the front along its
   * normals; markers keep their distances then. What is connected with what is its to
   * say.
   */
  class MarkedFront
  {
  public:
    /** @param nodes outlive this
     * @param threads results have the same bits for any number */
    MarkedFront(const PlaneNodes &nodes, int threads);

    /** Begin anew from the particles' splines. */
    void seed(const PlaneFront &front, bool solid_beyond);

    /**
     * Move by a step of the particles.
     * @param front before the step
     * @param ways of its particles in the step (m)
     * @param number, time of the step, for messages
     * @throws cases::NumericalError if phi or a marker is no longer a number
     */
    void carry(const PlaneFront &front, const std::vector<PlanePoint> &ways, long number,
               double time);

    /** phi at a place, cubic between the nodes along each axis (m). */
    double value(const PlanePoint &place) const;

    /** Points on the zeros of phi. */
    Contours contours() const;

    /** Points on the zeros of another function, negative in solid, on the same grid; it
     * is asked within the band only and has the sign of phi beyond. */
    Contours contours(const PlaneLevelSet &level_set) const;

    /** Distance between the grid's nodes (m). */
    double spacing() const
    {
      return grid.spacing();
    }

    /** Largest |phi| at active particles (m). */
    double mismatch(const PlaneFront &front) const;

    /**
     * Move the active particles along their normals onto phi = 0: Newton's method, two
     * steps of at most half a spacing. Normals and curvatures anew.
     * @param ways of the particles in the step: none goes farther than half of that, so
     * that none turns back
     */
    void reproject(PlaneFront &front, const std::vector<PlanePoint> &ways) const;

    /** Nodes of the band, and markers moved, summed over the steps. */
    double node_steps = 0, marker_steps = 0;

  private:
    void find_velocity(const PlaneFront &front, const std::vector<PlanePoint> &ways);

    const PlaneNodes &nodes;
    const int threads;
    const level_set::Grid grid;
    std::unique_ptr<level_set::LevelSet> phi;
    std::unique_ptr<level_set::MarkerScheme> markers;
    level_set::NodeVelocity velocity; ///< the way of a step (m)
    level_set::Advection advection;
    level_set::Reinitialisation reinitialise;
    long carried = 0; ///< since it was seeded
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
