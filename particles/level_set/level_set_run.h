#ifndef meltfront_particles_level_set_level_set_run_h
#define meltfront_particles_level_set_level_set_run_h

#include <particles/level_set/level_set.h>

#include <functional>

namespace meltfront::particles::level_set
{
  /** How a front is carried along by a prescribed velocity. */
  struct TransportParameters
  {
    double end_time = 1; ///< s, > 0
    double courant_number
        = 0.5; ///< largest component of velocity * step / spacing, 0 to 1
    int reinitialise_every = 10; ///< steps; 0: never
    int iterations = 10;         ///< of one reinitialisation
    long equal_parts = 1;        ///< of the time, whose ends fall on ends of steps
    LevelSetParameters level_set;
  };

  /** The steps that a run takes, all of one length. */
  struct StepCount
  {
    long steps = 0;
    double length = 0; ///< s
  };

  /**
   * Steps such that the velocity's largest component, found at all nodes and 17 times,
   * crosses no more than the Courant number's part of a spacing in each.
   * @throws cases::InputError for parameters out of range, a velocity that is no number
   */
  StepCount count_steps(const Grid &grid, const cases::VelocityField &velocity,
                        const TransportParameters &parameters);

  /** What a run tells after each step, and once before the first. */
  struct TransportStep
  {
    const LevelSet &front;
    long step = 0;   ///< 0: the start
    double time = 0; ///< s
  };

  using TransportCallback = std::function<void(const TransportStep &)>;

  /** What a run ends with. */
  struct TransportResult
  {
    LevelSet front;
    StepCount steps;
    double node_steps = 0; ///< nodes of the band, summed over the steps: the work
  };

  /**
   * The level set method by itself: the front carried along, phi made a distance again
   * every few steps.
   *
   * @param initial phi at the start: its sign right everywhere, a distance near the front
   * @throws cases::InputError, cases::NumericalError
   */
  TransportResult run_level_set(const Grid &grid, const ScalarFunction &initial,
                                const cases::VelocityField &velocity,
                                const TransportParameters &parameters,
                                const TransportCallback &callback = {});
} // namespace meltfront::particles::level_set

#endif
