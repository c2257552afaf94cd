#ifndef meltfront_particles_rkpm_tracked_plane_relax_h
#define meltfront_particles_rkpm_tracked_plane_relax_h

#include <particles/rkpm_tracked/node_relaxation.h>
#include <particles/rkpm_tracked/plane/heat.h>

#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /**
   * Relaxes the inner nodes of both phases in the plane, each phase by itself among the
   * front's particles and the nodes on its walls. No node crosses the front by that, and
   * none comes nearer to a wall than nodes are laid.
   *
   * A node whose home the front is about to pass is let go (RelaxRule::springs): it is
   * put so near to the front that the next step passes it, and changes its phase by that.
   */
  class PlaneRelaxation
  {
  public:
    /** Nodes are at home where they are now. @param nodes outlive the object */
    PlaneRelaxation(const PlaneNodes &nodes, RelaxRule rule, int threads);

    /**
     * Where the nodes of a state go.
     * @param solid_beyond whether what no curve goes round is solid
     * @param time until they are relaxed again (s)
     */
    std::vector<PlanePoint> places(const PlaneState &state, bool solid_beyond,
                                   double time);

    /**
     * Give a state its temperatures at other places of the nodes: a node takes its own
     * along, changed by its way times the gradient at the middle of it; where it was in
     * another phase at the state's time, the polynomial about its new place tells. Both
     * by fits of one order above that of the collocation to the points of the phase, and
     * within the range of the phase. Nodes that stay keep theirs.
     */
    void resample(const std::vector<PlanePoint> &places, const PlaneHeat &heat,
                  PlaneState &state) const;

  private:
    struct Phase;

    void gather(const PlaneState &state, const FrontIndex &index, double time, bool solid,
                Phase &phase, std::vector<PlanePoint> &places) const;
    bool let_go(const PlaneState &state, const FrontIndex &index, double time,
                std::size_t node, PlanePoint &place) const;
    void keep_apart(const FrontIndex &index, std::vector<PlanePoint> &places) const;

    const PlaneNodes &nodes;
    RelaxRule rule;
    int threads;
    std::vector<PlanePoint> homes;
    PlaneBins front_bins;
    bool settled = false; ///< relaxed once: only nodes about the front move any more
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
