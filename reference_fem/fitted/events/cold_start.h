#ifndef meltfront_reference_fem_fitted_events_cold_start_h
#define meltfront_reference_fem_fitted_events_cold_start_h

#include <reference_fem/fitted/events/segment.h>
#include <reference_fem/fitted/setup.h>

#include <cases/exact_solution.h>

#include <functional>
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

  /** One phase along the ray, at a time. */
  struct OnePhase
  {
    double time = 0;                               ///< s
    std::function<double(double r)> temperature{}; ///< by coordinate on the ray (m)
    bool solid = true;
    double heat = 0;    ///< that it holds, sensible and latent
    HeatContent before; ///< walls and sources: what came in until then
  };

  /** The scene's initial state, which holds so much heat. */
  OnePhase initial_phase(const EventScene &setting, double heat);

  /** Steps for the rest of the run (s). */
  int steps_for(const EventScene &setting, double from);

  /** Time until a wall's value may jump or bend next (s); infinite where none does. */
  double time_to_breakpoint(const cases::Scene &scene, double time);

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

  /** Whether a front appears at the start of the scene, which starts in one phase.
   * @throws Refusal for sources that start none or grow by another law. */
  std::optional<SuddenStart> sudden_start(const EventScene &setting,
                                          const OnePhase &initial);

  /** The front that a wall starts whose temperature is, or jumps to, beyond the melting
   * temperature of what lies at it; none where it is not. */
  std::optional<SuddenStart> start_at_wall(const EventScene &setting,
                                           const OnePhase &state, bool inner);

  /**
   * The run from a front that is so close to its end of the ray that the local solution
   * holds: 1e-4 of the ray, or less where little time or a fast liquid demands it. The
   * new phase has equal cells, the old one cells that widen from the front; the clock is
   * the root of the time since the start, and its steps lengthen. A wall at the other end
   * that is held elsewhere than what lies at it has its layer, too, that of a half-space.
   *
   * Heat that came in through the wall before is by definition what the seed holds more
   * than the state did, less what sources gave.
   */
  RunSegment seeded_stretch(const EventScene &setting, const SuddenStart &start,
                            const OnePhase &state);
} // namespace meltfront::reference_fem::fitted

#endif
