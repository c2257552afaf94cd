#ifndef meltfront_particles_benchmarks_crowd_h
#define meltfront_particles_benchmarks_crowd_h

#include <particles/core/particle_operator.h>

#include <vector>

namespace meltfront::particles::benchmarks
{
  /** How many particles, and how many neighbours each has. */
  struct CrowdSize
  {
    const char *name;
    int dimension;
    int per_side;
    double radius; ///< of interaction, in particle spacings
  };

  /** Particles in a unit box, sorted along a curve, with an operator between them and a
   * state that has a front in the middle. */
  struct Crowd
  {
    explicit Crowd(const CrowdSize &size);

    double radius; ///< of interaction (m)
    ParticleStorage particles;
    NeighbourList neighbours;
    std::vector<double> coefficients;
    ParticleOperator rows;
    std::vector<double> enthalpy;         ///< solid on the left, liquid on the right
    std::vector<double> u;                ///< Kirchhoff variable of the enthalpy
    std::vector<double> solute;           ///< a second field
    std::vector<double> result, result_2; ///< of sweeps over one and two fields
  };

  /** Latent heat of the substance in the crowd's state (J/kg). */
  inline constexpr double latent_heat = 1;
} // namespace meltfront::particles::benchmarks

#endif
