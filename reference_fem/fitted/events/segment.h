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

  /** A part of a run with one mesh: phases between fronts and walls. */
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
   * Of the one phase that a ray holds when fronts start: cells that widen from each end
   * at which a layer (m, 0: none) forms. A quarter of it is 1/cells wide at first.
   */
  std::vector<double> shares_of_layers(const RayScene &rays, double at_inner,
                                       double at_outer);

  /**
   * The cells of an interval, those at one of its ends anew: from a share of @p first on
   * they widen by @p ratio until they are as wide as those that were there, which go on
   * from their next face.
   */
  std::vector<double> drawn_shares(const std::vector<double> &shares, double first,
                                   double ratio, bool to_lower);

  /** By how much cells widen from a layer. */
  double widening(const RayScene &rays);
} // namespace meltfront::reference_fem::fitted

#endif
