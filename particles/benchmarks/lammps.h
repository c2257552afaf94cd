#ifndef meltfront_particles_benchmarks_lammps_h
#define meltfront_particles_benchmarks_lammps_h

#include <particles/greenspan/motion/pair_force.h>
#include <particles/greenspan/motion/particle_state.h>

#include <iosfwd>
#include <optional>
#include <string>

namespace meltfront::particles::benchmarks
{
  /** Path of LAMMPS' program `lmp`, if one is installed. meltfront does not need it. */
  std::optional<std::string> find_lammps();

  /** The pair force as LAMMPS' `pair_style mie/cut` has it. */
  struct MiePotential
  {
    double epsilon, sigma, repulsion_exponent, attraction_exponent, cutoff;

    /** epsilon = -U(r0); sigma = [H ga / (G gr)]^(1/(gr - ga)), exponents one less than
     * those of the force. */
    explicit MiePotential(const greenspan::PairForce &force);
  };

  /** What LAMMPS makes of a state. */
  struct LammpsRun
  {
    greenspan::ParticleState end; ///< positions and velocities of the same time
    double seconds = 0;           ///< of its loop over the steps
  };

  /**
   * Run LAMMPS on an isolated solid of the plane, one process, in a temporary directory.
   * @throws cases::OutputError if it does not run or leaves no result
   */
  LammpsRun run_lammps(const std::string &program, const greenspan::PairForce &force,
                       const greenspan::ParticleState &start, double time_step,
                       long steps);

  /** The same crystals in turn with LAMMPS and with meltfront: times and their ratio; one
   * sentence where LAMMPS is not installed. */
  void compare_with_lammps(std::ostream &out);
} // namespace meltfront::particles::benchmarks

#endif
