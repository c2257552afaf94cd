#ifndef meltfront_particles_greenspan_generation_h
#define meltfront_particles_greenspan_generation_h

#include <cases/outline.h>
#include <particles/greenspan/motion/motion_parameters.h>
#include <particles/greenspan/motion/particle_state.h>

#include <cstdint>

namespace meltfront::particles::greenspan
{
  /** A row of particles along a side and the rows above it; the lowest lies at y = 0. */
  struct HexagonalLattice
  {
    /** L particles on the base and one less in each row: L (L + 1) / 2 of them. */
    static ParticleState triangle(int base, double spacing);

    /** Rows of L and L - 1 particles in turn, as table 2 of the report. */
    static ParticleState rectangle(int base, int rows, double spacing);

    /** All points within a radius of the centre, which is one of them. */
    static ParticleState disk(double radius, double spacing);

    /**
     * All points inside an outline, of the lattice with one at its centre.
     * @throws cases::InputError if there is none
     */
    static ParticleState within(const cases::Outline &outline, double spacing);

    /** All points of a cubic close packing within a radius of the centre, which is one of
     * them, in space. */
    static ParticleState close_packed_ball(double radius, double spacing);

    /** All points of a cubic close packing in a box of so many cells of four particles
     * along each side, in space. */
    static ParticleState close_packed_box(const std::array<int, 3> &cells,
                                          double spacing);
  };

  /**
   * Gravity that loads a bond at the bottom of so many rows as 32 does in the solids of
   * the report, which have seven. With 32 large solids are crushed.
   */
  double scaled_gravity(int rows);

  /** How a solid is laid on the base. */
  struct Relaxation
  {
    PairForce force;
    double gravity = 32;
    double drag = 20;    ///< per unit of time
    double duration = 3; ///< units of time
    double time_step = 1e-4;
    int threads = 1;

    /** Drag and duration that suit the height of a solid of so many rows: drag that damps
     * the slowest vibration, and ten times as long as it then needs. */
    static Relaxation for_rows(const PairForce &force, int rows);
  };

  /** A solid at rest on the base. */
  struct RelaxedSolid
  {
    ParticleState state; ///< velocities zero, step 0
    double residual = 0; ///< root mean square of the accelerations that nothing carries
    std::size_t bonds = 0;
  };

  /**
   * Let a lattice settle on the base (3.1) under gravity and drag. What is left of the
   * acceleration is the creep of the particles on the base, whose friction depends on the
   * time step.
   * @throws cases::NumericalError if bonds break or form: gravity is too strong
   */
  RelaxedSolid relax_on_base(const ParticleState &lattice, const Relaxation &relaxation);

  /** Velocities of a temperature (mean kinetic energy of a particle over half the
   * dimension), normally distributed, without momentum. */
  void set_temperature(ParticleState &state, double temperature, std::uint64_t seed);
} // namespace meltfront::particles::greenspan

#endif
