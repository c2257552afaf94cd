#ifndef meltfront_particles_sph_initial_state_h
#define meltfront_particles_sph_initial_state_h

#include <particles/sph/discretisation.h>

#include <vector>

namespace meltfront::particles
{
  /**
   * Specific enthalpy of each particle at the start (J/kg).
   *
   * Where the state is that of an exact solution, a planar one gives the particle's cell
   * its exact heat, and a cylindrical or spherical one the exact temperature, or, in
   * cells that the front cuts, the fraction of the cell that has melted: the first front
   * is exact to a small part of a particle.
   */
  std::vector<double> initial_enthalpy(const Discretisation &discretisation);
} // namespace meltfront::particles

#endif
