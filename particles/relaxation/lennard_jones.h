#ifndef meltfront_particles_relaxation_lennard_jones_h
#define meltfront_particles_relaxation_lennard_jones_h

#include <particles/core/neighbour_list.h>
#include <particles/core/particle_storage.h>
#include <particles/relaxation/conjugate_gradients.h>

#include <cmath>
#include <optional>

namespace meltfront::particles
{
  /** The potential of Lennard and Jones as a surrogate for the error of disorder. */
  struct LennardJones
  {
    double length = 1;    ///< sigma (m)
    double energy = 1e-2; ///< epsilon: sets the scale of energies only
    double cutoff = 2.5;  ///< over sigma, beyond which particles do not meet

    /** e(r) = epsilon [(sigma/r)^12 - (sigma/r)^6], r > 0: repels below 2^(1/6) sigma,
     * where it is -epsilon/4, and attracts beyond (Erickson et al. 2016, SAND2016-9800,
     * (5.1)). Not cut off. */
    double pair_energy(double distance) const
    {
      const double ratio = length / distance;
      const double cube = ratio * ratio * ratio;
      const double sixth = cube * cube;
      return energy * (sixth * sixth - sixth);
    }
  };

  /**
   * The energy of moving particles among themselves and with fixed ones, each pair nearer
   * than the cutoff once: sum of e(r) - e(cutoff), continuous in the positions.
   *
   * Neighbours are kept within the cutoff and a skin, and found anew when a particle has
   * moved by half of it. Sums run in a fixed order for any number of threads.
   */
  class LennardJonesEnergy
  {
  public:
    /** @throws cases::InputError if length, energy or cutoff is not positive. */
    LennardJonesEnergy(int dimension, const ParticleStorage &fixed,
                       const LennardJones &potential, int threads);

    /** Energy and its gradient at the moving particles' places. O(N). */
    double operator()(const Coordinates &places, Coordinates &gradient);

    long list_builds() const
    {
      return builds;
    }

  private:
    void update_neighbours(const Coordinates &places);
    template <int Dimension>
    double evaluate(std::size_t moving, Coordinates &gradient) const;

    int dimension;
    LennardJones potential;
    int threads;
    ParticleStorage fixed;
    ParticleStorage all; ///< moving particles, then fixed ones
    Coordinates listed;  ///< places when the neighbours were found
    std::optional<NeighbourList> neighbours;
    long builds = 0;
    mutable std::vector<double> row_energy;
  };

  /** How particles are relaxed. */
  struct LennardJonesRelaxation
  {
    LennardJones potential;
    double longest_step = 0.1;   ///< of a particle in an iteration, over sigma
    double wall_distance = 1e-3; ///< kept from the walls of the box, over sigma
    double tolerance = 1e-12;    ///< see DescentParameters
    /** Stop when the energy fell by less in a window of iterations, over epsilon and the
     * number of particles; 0: go on. */
    double least_fall = 1e-3;
    long most_iterations = 200000;
    int threads = 1;
  };

  /**
   * Move particles to a minimum of their energy inside a box, with fixed particles (on
   * its walls, or anywhere) as neighbours. The minimum is a local one, near a hexagonal
   * packing with defects; the start decides which.
   *
   * @throws cases::InputError if a particle starts outside of the box or on another one.
   */
  Descent relax_by_lennard_jones(ParticleStorage &moving, const ParticleStorage &fixed,
                                 const CoordinateBox &box,
                                 const LennardJonesRelaxation &parameters);
} // namespace meltfront::particles

#endif
