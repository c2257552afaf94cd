#ifndef meltfront_particles_rkpm_tracked_line_start_h
#define meltfront_particles_rkpm_tracked_line_start_h

#include <cases/scene.h>
#include <particles/rkpm_tracked/line/problem.h>

#include <cstdint>
#include <string>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** The line problem that a scene poses. @throws cases::Refusal for what is not treated.
   */
  LineProblem pose_line_problem(const cases::Scene &scene,
                                const TrackingParameters &parameters, std::uint64_t seed);

  /** A place of the line in space. */
  cases::Position position_on_line(double x);

  /** The state at a scene's start. Fronts are where its level set, the exact solution or
   * else the temperature says. */
  LineState initial_state(const cases::Scene &scene, const LineProblem &problem);

  /** Where a run sets out from. */
  struct LineStart
  {
    LineState state;
    std::vector<LineState> older; ///< newest first
    std::string how;              ///< in words
    bool from_initial = false;    ///< its walls are yet to get their temperatures
  };

  /**
   * How a run sets out from its initial state: with the exact solution's history; from
   * the similarity solution, a little later, where a uniform phase meets one wall of
   * constant temperature beyond the melting point; or from the initial state itself.
   * @param step the first step that is planned (s)
   */
  LineStart choose_start(const cases::Scene &scene, const LineProblem &problem,
                         const TrackingParameters &parameters, const LineState &initial,
                         double step);
} // namespace meltfront::particles::rkpm_tracked

#endif
