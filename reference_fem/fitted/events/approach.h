#ifndef meltfront_reference_fem_fitted_events_approach_h
#define meltfront_reference_fem_fitted_events_approach_h

#include <reference_fem/fitted/events/phase_check.h>

#include <limits>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** An interval that becomes thinner, and for how long. */
  struct Approach
  {
    unsigned int interval = 0;
    double thickness = 0;                                       ///< m
    double remaining = std::numeric_limits<double>::infinity(); ///< on the clock
  };

  /** Of one interval. @param rate du/dclock */
  Approach approach_of(const FittedProblem &problem, unsigned int interval,
                       const dealii::Vector<double> &u,
                       const dealii::Vector<double> &rate);

  /** Of the interval that vanishes first. */
  Approach soonest(const FittedProblem &problem, const dealii::Vector<double> &u,
                   const dealii::Vector<double> &rate);

  /** Whether an interval is so thin that it is dropped: 1e-9 of the ray, at its centre of
   * the volume. */
  bool has_vanished(const RayMesh &mesh, const Approach &approach);

  /** Whether a wall passes the melting temperature when the phase at it may already have
   * vanished: the step was too long to tell. */
  bool doubtful(const FittedProblem &problem, const std::vector<WallCrossing> &crossings,
                const dealii::Vector<double> &u, const dealii::Vector<double> &rate,
                double step);
} // namespace meltfront::reference_fem::fitted

#endif
