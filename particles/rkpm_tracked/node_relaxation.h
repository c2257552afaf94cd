#ifndef meltfront_particles_rkpm_tracked_node_relaxation_h
#define meltfront_particles_rkpm_tracked_node_relaxation_h

#include <particles/relaxation/lennard_jones.h>
#include <particles/rkpm_tracked/tracking_options.h>

namespace meltfront::particles::rkpm_tracked
{
  /** How the nodes of a phase are relaxed. */
  struct NodeRelaxation
  {
    RelaxRule rule = RelaxRule::springs;
    double spacing = 0; ///< of the nodes (m)
    int threads = 1;
  };

  /**
   * Move the inner nodes of one phase to lower energy among fixed neighbours: the
   * particles on its front and the nodes on its walls (Erickson et al. 2016,
   * SAND2016-9800, chapter 5, applied as section 6.4 proposes).
   *
   * RelaxRule::lennard_jones is the published surrogate, its length the spacing.
   * RelaxRule::springs keeps of it what repels and adds a spring to where each node was
   * laid,
   *
   *   E = sum of e(r) - e(h) over pairs nearer than h + 5 epsilon/sigma^2 |x - home|^2,
   *
   * sigma = h / 2^(1/6): a lattice away from the front is at rest, and nodes that the
   * front has left behind go home.
   *
   * @param moving no two, and none of the fixed ones, at the same place
   * @param homes of the moving nodes, as many
   * @param box what nodes must not leave
   */
  Descent relax_phase(ParticleStorage &moving, const ParticleStorage &homes,
                      const ParticleStorage &fixed, const CoordinateBox &box,
                      const NodeRelaxation &how);
} // namespace meltfront::particles::rkpm_tracked

#endif
