#ifndef meltfront_particles_greenspan_calibration_bulk_h
#define meltfront_particles_greenspan_calibration_bulk_h

#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/motion.h>

namespace meltfront::particles::greenspan
{
  /** A rectangle of the plane that repeats itself in both directions. */
  struct PeriodicCrystal
  {
    PairForce force;
    double spacing = 0; ///< of the lattice; 0: the equilibrium distance
    int columns = 24;   ///< particles in a row
    int rows = 24;      ///< even

    /** Hexagonal lattice with rows along x, at rest. @throws cases::InputError */
    ParticleState lattice() const;
  };

  /** A phase held at a temperature and a pressure. */
  struct BulkSettings
  {
    PeriodicCrystal crystal;
    double temperature = 35;
    double pressure = 10;
    bool liquid = false; ///< melt it first, at twice the temperature
    double time_step = 4e-4;
    double equilibration = 10; ///< time before anything is averaged
    double duration = 20;      ///< time of the averages
    std::uint64_t seed = 1;
  };

  /** Averages over time. */
  struct BulkProperties
  {
    double temperature = 0;
    double pressure = 0;
    double density = 0;       ///< particles per area
    double enthalpy = 0;      ///< per particle: energy + pressure / density
    double order = 0;         ///< of hexatic order, phase by phase, see hexatic_order
    double lattice_order = 0; ///< along the lattice of the start, see lattice_order
  };

  /**
   * Properties of a phase at constant temperature (Langevin's bath) and pressure (the
   * area is scaled towards it; Berendsen et al., J. Chem. Phys. 81, 1984).
   * @throws cases::InputError, cases::NumericalError
   */
  BulkProperties measure_bulk(const BulkSettings &settings);

  /** The state at the end of such a run, with the area of the averaged density. */
  ParticleState equilibrated_bulk(const BulkSettings &settings);
} // namespace meltfront::particles::greenspan

#endif
