#ifndef meltfront_reference_fem_fitted_events_cold_start_h
#define meltfront_reference_fem_fitted_events_cold_start_h

#include <reference_fem/fitted/events/layered_state.h>

#include <cases/exact_solution.h>

#include <optional>

namespace meltfront::reference_fem::fitted
{
  /** A front that appears at once, when a wall is held beyond the melting temperature or
   * a source at the centre is switched on. */
  struct SuddenStart
  {
    bool at_inner_end = true; ///< of the ray, else at the outer wall
    /** The solution close to that end, in the distance from it, from the start on:
     * Neumann's for a wall, whatever its curvature, those of a line or a point sink. */
    std::shared_ptr<const cases::ExactSolution> local;
    std::string cause;
  };

  /** The fronts that appear at once in a state: of a source at the centre that the scene
   * starts with in one phase, and start_at_wall().
   * @throws Refusal for sources that start none or grow by another law. */
  std::vector<SuddenStart> sudden_starts(const EventScene &setting,
                                         const LayeredState &initial);

  /** The front that a wall starts whose temperature is, or jumps to, beyond the melting
   * temperature of what lies at it; none where it is not. */
  std::optional<SuddenStart> start_at_wall(const EventScene &setting,
                                           const LayeredState &state, bool inner);

  /**
   * The run from fronts that are so close to their ends of the ray that the local
   * solutions hold: 1e-4 of the room there, or less where little time or a fast liquid
   * demands it. New phases have equal cells, the old one cells that widen from the front;
   * the clock is the root of the time since the start, and its steps lengthen. A wall
   * without a front has its layers_at_walls(), too.
   *
   * Heat that came in through the walls before is by definition what the seed holds more
   * than the state did, less what sources gave.
   */
  RunSegment seeded_stretch(const EventScene &setting,
                            const std::vector<SuddenStart> &starts,
                            const LayeredState &state);
} // namespace meltfront::reference_fem::fitted

#endif
