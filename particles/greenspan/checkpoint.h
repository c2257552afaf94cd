#ifndef meltfront_particles_greenspan_checkpoint_h
#define meltfront_particles_greenspan_checkpoint_h

#include <particles/greenspan/diagnostics.h>

#include <optional>
#include <string>

namespace meltfront::particles::greenspan
{
  /** All that a run goes on from, bit for bit. */
  struct Checkpoint
  {
    std::string run; ///< what run it is of, see run_fingerprint()
    ParticleState state;
    Diagnostics::Memory memory;
    double initial_energy = 0;
    double energy_error = 0; ///< largest change of the energy so far
  };

  /** Of everything that the course of a run depends on: parameters, starting positions
   * and velocities, steps, interval. */
  std::string run_fingerprint(const Experiment &experiment);

  /**
   * Write to a temporary name beside the file, then rename: a kill leaves the old one or
   * the new one.
   * @throws cases::OutputError if it cannot be written
   */
  void write_checkpoint(const std::string &path, const Checkpoint &checkpoint);

  /**
   * The checkpoint in a file; nothing if there is no file.
   * @throws cases::InputError if it is none or is that of another run
   */
  std::optional<Checkpoint> read_checkpoint(const std::string &path,
                                            const Experiment &experiment);
} // namespace meltfront::particles::greenspan

#endif
