#ifndef meltfront_particles_rkpm_tracked_line_similarity_start_h
#define meltfront_particles_rkpm_tracked_line_similarity_start_h

#include <cases/exact/wall_layer.h>
#include <cases/exact_solution.h>
#include <particles/rkpm_tracked/line/problem.h>

#include <memory>

namespace meltfront::particles::rkpm_tracked
{
  /** An exact solution's state at the nodes, from the upper end if mirrored. */
  LineState exact_state(const cases::ExactSolution &exact, const LineProblem &problem,
                        double time, bool mirrored);

  /**
   * Neumann's solution of the one wall that calls for a phase: where a uniform phase
   * meets a wall that is held at a temperature beyond the melting point, it is exact
   * until it reaches the other wall. One that is held elsewhere than the phase from the
   * start on, or gives it a flux, has a layer of its own there (WallLayer), as long as
   * the two are apart.
   */
  class SimilarityStart
  {
  public:
    /** @param duration of the run (s), of which the start is a small share */
    SimilarityStart(const LineProblem &problem, const LineState &initial,
                    double duration);

    /** Whether there is such a solution. */
    explicit operator bool() const
    {
      return solution != nullptr;
    }

    /** The time since the start at which the layer has a thickness (s). */
    double time_of(double thickness) const;

    /** Whether the solution holds until a time since the start. */
    bool holds(double since) const;

    /** The state at a time since the start. */
    LineState state(double since) const;

  private:
    const LineWall &other_wall() const;

    /** What the layer at the other wall adds in a distance from it (K). */
    double other_layer(double distance, double since) const;

    /** Whether the other wall leaves the phase as it is, or does what other_layer()
     * says, until a time since the start. */
    bool other_holds(double since) const;

    const LineProblem &problem;
    double begin, duration;
    double far, wall = 0;   ///< temperatures
    cases::WallLayer other; ///< at the other wall
    std::size_t side = 0;   ///< of the wall
    std::shared_ptr<const cases::ExactSolution> solution;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
