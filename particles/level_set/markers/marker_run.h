#ifndef meltfront_particles_level_set_markers_marker_run_h
#define meltfront_particles_level_set_markers_marker_run_h

#include <particles/level_set/level_set_run.h>
#include <particles/level_set/markers/marker_scheme.h>

namespace meltfront::particles::level_set
{
  /** A front carried along by a velocity, and markers that correct it. */
  struct MarkerRunParameters
  {
    TransportParameters transport;
    MarkerParameters markers;
    /** By how much the grid's front lies off at the start, which the markers know better
     * (spacings). */
    Position grid_offset{};
    long steps_at_rest = 5; ///< taken where the velocity is zero
    int iterations_at_rest
        = 20; ///< of the reinitialisation after them, a correction follows
  };

  /** What a run tells after each step, and once before the first. */
  struct MarkerStep
  {
    const LevelSet &front;
    const Markers &markers;
    long step = 0;   ///< 0: the start
    double time = 0; ///< s
    MarkerWork work; ///< since the start
  };

  using MarkerCallback = std::function<void(const MarkerStep &)>;

  /** What a run ends with. */
  struct MarkerResult
  {
    LevelSet front;
    Markers markers;
    StepCount steps;
    double node_steps = 0; ///< nodes of the band, summed over the steps
    MarkerWork work;
  };

  /**
   * A level set that markers correct after every step and every reinitialisation. Where
   * the velocity is zero, some corrections are followed by a reinitialisation and the
   * last correction.
   *
   * @param initial signed distance from the front at the start (m)
   * @throws cases::InputError, cases::NumericalError
   */
  MarkerResult run_markers(const Grid &grid, const ScalarFunction &initial,
                           const cases::VelocityField &velocity,
                           const MarkerRunParameters &parameters,
                           const MarkerCallback &callback = {});
} // namespace meltfront::particles::level_set

#endif
