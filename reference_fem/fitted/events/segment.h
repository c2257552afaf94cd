#ifndef meltfront_reference_fem_fitted_events_segment_h
#define meltfront_reference_fem_fitted_events_segment_h

#include <reference_fem/fitted/fitted_problem.h>
#include <reference_fem/fitted/setup.h>

#include <memory>
#include <string>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** Equal steps of a clock up to an end. */
  struct StepRange
  {
    double end = 0, step = 0;
  };

  /** What made a segment begin. */
  struct Event
  {
    double time = 0;  ///< s
    std::string text; ///< one clause; empty for the start of the run
  };

  /** A part of a run with one mesh: one phase, or two with a front between them. */
  struct RunSegment
  {
    std::shared_ptr<FittedProblem> problem;
    dealii::Vector<double> state;
    double time = 0; ///< of the state (s)

    /** Heat that came in before the segment (walls, sources), and that of a phase that
     * was dropped (sensible, latent); see FittedProblem::heat() for the rest. */
    HeatContent before;

    std::vector<StepRange> steps;
    Event event;
  };

  /**
   * @p n steps from one value of a clock > 0 to another that are equal in
   * clock^(1/power): they lengthen with the clock, so that a start at a small value
   * counts as much as it needs to.
   */
  std::vector<StepRange> lengthening_steps(double begin, double end, int n, double power);

  /**
   * Shares of an interval taken by cells that begin with a share of @p first at the front
   * and widen by @p ratio up to a share of @p largest. From 0 to 1, the front at the end
   * that @p front_first says.
   */
  std::vector<double> widening_shares(double first, double ratio, double largest,
                                      bool front_first);

  /**
   * Of a new phase beside a wall and an old one: equal cells in the new one, in the old
   * one cells that widen from the front, where a quarter of @p layer (m) is 1/cells wide
   * at first, and in the same way from the far end if @p far_layer is above 0.
   *
   * @param inner the new phase is at the inner end of the rays
   */
  RayMesh seed_mesh(const RayScene &rays, bool inner, double layer, double far_layer);
} // namespace meltfront::reference_fem::fitted

#endif
