#ifndef meltfront_reference_fem_fitted_events_cold_start_h
#define meltfront_reference_fem_fitted_events_cold_start_h

#include <reference_fem/fitted/events/stretch.h>
#include <reference_fem/fitted/setup.h>

#include <cases/exact_solution.h>

#include <optional>

namespace meltfront::reference_fem::fitted
{
  /** A scene in one dimension, and how it is to be solved. */
  struct EventScene
  {
    const cases::Scene &scene;
    const cases::EffectSet &effects;
    const RunOptions &options;
    RayScene rays;
  };

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

  /**
   * Whether a front appears at the start of the scene, which starts in one phase.
   * @throws Refusal where fronts would appear at both ends.
   */
  std::optional<SuddenStart> sudden_start(const EventScene &setting);

  /**
   * The run from a front that is so close to its end of the ray that the local solution
   * holds: 1e-4 of the ray, or less where little time or a fast liquid demands it. The
   * new phase has equal cells, the old one cells that widen from the front; the clock is
   * the root of the time since the start, and its steps lengthen.
   *
   * Heat that came in through the wall before is by definition what the seed holds more
   * than the initial state did, less what sources gave.
   */
  Stretch seeded_stretch(const EventScene &setting, const SuddenStart &start,
                         double initial_heat);
} // namespace meltfront::reference_fem::fitted

#endif
