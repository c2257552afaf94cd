#ifndef meltfront_particles_sph_effective_conductivity_h
#define meltfront_particles_sph_effective_conductivity_h

#include <particles/sph/discretisation.h>

namespace meltfront::particles
{
  class ParticleOperator;

  /**
   * What displaced particles conduct along x, over what their material does.
   *
   * Their pairs are a network of conductors g_ab. With u = x held along the walls, as
   * deep as the kernel reaches, the other u balance the flows, sum_b g_ab (u_b - u_a) =
   * 0, and the particles in between dissipate
   *
   *   sum_a 1/2 sum_b g_ab (u_b - u_a)^2 / sum_a V
   *
   * of a unit gradient's 1 (the cell problem of homogenisation). On a lattice that is 1;
   * a network of scattered particles conducts less, however many they are: an error that
   * no refinement shows.
   *
   * @param rows g_ab, of a material that conducts alike everywhere, symmetric.
   * @return 1 where no particle is that far from all walls.
   */
  double effective_conductivity(const Discretisation &dis, const ParticleOperator &rows);

  /** @throws Refusal where it is off by more than a twentieth, with its value; not asked
   * beside an inclusion. */
  void require_true_conductivity(const Discretisation &dis, const ParticleOperator &rows);
} // namespace meltfront::particles

#endif
