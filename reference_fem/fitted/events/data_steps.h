#ifndef meltfront_reference_fem_fitted_events_data_steps_h
#define meltfront_reference_fem_fitted_events_data_steps_h

#include <reference_fem/fitted/events/segment.h>

#include <functional>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** What a scene prescribes as a function of time: wall temperatures (less the melting
   * one), fluxes and surroundings, the strength of a source. */
  struct TimeData
  {
    std::vector<std::function<double(double time)>> values;
    std::vector<double> breakpoints; ///< where they may jump or bend (s), ascending

    /** Steps after a jump that are shorter than this (s) resolve nothing, and elements
     * overshoot in them: the spacing h of nodes at the walls that vary gives
     * h^2/(3 alpha), from which on no two nodes of linear elements are coupled by their
     * mass more than by conduction. */
    double shortest_after_jump = 0;
  };

  /** Those of a problem that vary and are no exact solution's, on up to 8 of its rays;
   * its cells as in the state @p u. The problem must outlive the result. */
  TimeData data_of(const FittedProblem &problem, const dealii::Vector<double> &u);

  /**
   * Steps divided so that they see the data.
   *
   * A step ends at each breakpoint, by rounding before it, so that its stages see the
   * values on the near side. After a jump steps begin small, but no shorter than
   * the cells can resolve, and double. A step over which
   * Radau's quadrature of the data differs from that of its parts (8 to 64) by more than
   * 1e-6 of the data's integral over all steps is halved until it does not. Steps that
   * see the data stay as planned, to the bit.
   *
   * @param begin      clock at which the first of them begins
   * @param controlled the integrator makes longer steps than planned where it can: each
   *                   is bound to its end where data vary
   */
  std::vector<StepRange> fit_to_data(const std::vector<StepRange> &planned, double begin,
                                     const Clock &clock, const TimeData &data,
                                     bool controlled);
} // namespace meltfront::reference_fem::fitted

#endif
