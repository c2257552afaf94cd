#ifndef meltfront_particles_core_relaxation_h
#define meltfront_particles_core_relaxation_h

#include <particles/core/kernels.h>
#include <particles/core/neighbour_list.h>
#include <particles/core/particle_storage.h>

#include <functional>
#include <vector>

namespace meltfront::particles
{
  /** A plane that reflects: particles do not cross it. */
  struct MirrorPlane
  {
    int direction;     ///< of its normal
    double coordinate; ///< m
    bool upper;        ///< the particles are below it
  };

  /** What keeps particles in their place while they relax. */
  struct RelaxationBounds
  {
    Periodicity periodicity;
    std::vector<MirrorPlane> mirrors;
    ParticleStorage fixed; ///< particles around the others, which stay
    /** Whether a particle may move, by its place; all may if empty. */
    std::function<bool(const std::array<double, 3> &)> movable;
  };

  /** What a relaxation did. */
  struct Relaxation
  {
    int sweeps = 0;
    double spread_before = 0; ///< standard deviation of the second moment mu, over one
    double spread_after = 0;
  };

  /**
   * Move disordered particles away from where they crowd, against the gradient of their
   * concentration,
   *
   *   r_a -= (h^2/2) sum_b V S_ab (r_a - r_b),
   *
   * S = W'/r of the kernel (1 - r/support)^3 (Desbrun and Gascuel 1996), whose slope does
   * not vanish at r = 0, so that no particles pair up,
   * by at most a twentieth of a spacing at once (particle shifting: Lind, Xu, Stansby and
   * Rogers 2012), until the spread of the second moment mu_a = -(1/d) sum_b V F_ab
   * r_ab^2 has settled: until ten sweeps together lower it by less than a hundredth, or
   * 300 are made. All sums run in a fixed order.
   */
  Relaxation relax(ParticleStorage &particles, const SmoothingKernel &kernel,
                   double spacing, const RelaxationBounds &bounds);
} // namespace meltfront::particles

#endif
