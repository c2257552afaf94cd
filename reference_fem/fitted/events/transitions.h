#ifndef meltfront_reference_fem_fitted_events_transitions_h
#define meltfront_reference_fem_fitted_events_transitions_h

#include <reference_fem/fitted/events/cold_start.h>
#include <reference_fem/fitted/time/integrator.h>

namespace meltfront::reference_fem::fitted
{
  /** The scene's initial state on a mesh without a front; its steps are equal in time. */
  RunSegment one_phase_stretch(const EventScene &setting);

  /**
   * A one-phase segment anew from a state, for a wall that passes the melting temperature
   * @p soon (s) afterwards: cells halved towards that wall down to the thermal layer's
   * width, so that they hold the same state, and steps equal in the root of time of
   * which twenty or more lead to the passing.
   */
  RunSegment refined_stretch(const EventScene &setting, const RunSegment &segment,
                             bool inner, double soon);

  /** How long after a wall has passed the melting temperature a front is seeded (s). */
  double time_of_seed(const EventScene &setting, const RunSegment &past, double crossing);

  /**
   * The run from the moment at which a wall of a one-phase segment has passed the melting
   * temperature.
   *
   * The one-phase solution, continued for a time tau beyond that moment, has a wall that
   * is D beyond the melting temperature. Held at it instead, the old phase loses or gains
   * the heat of a ramp, 4 D i^2erfc(x/(2 sqrt(a tau))) (Carslaw & Jaeger 1959, section
   * 2.5), to latent heat: behind a wall of given flux the front is where the heat
   * balances, s = 4 k D sqrt(tau)/(3 rho L sqrt(pi a)) to leading order; before one of
   * given temperature at s = v tau with rho L v^2 + q v = k_new D/tau, q the flux out of
   * the old phase. The new phase has a linear profile.
   *
   * @param crossing  time at which the wall is at the melting temperature (s)
   */
  RunSegment late_stretch(const EventScene &setting, const RunSegment &past,
                          double crossing, const dealii::Vector<double> &u, bool inner,
                          const IntegrationOptions &integration);

  /**
   * The run from the moment at which the front is so close to an end of the ray that the
   * phase there is dropped. What heat it still held is kept in RunSegment::before.
   */
  RunSegment remaining_stretch(const EventScene &setting, const RunSegment &past,
                               double time, const dealii::Vector<double> &u,
                               bool inner_vanishes);
} // namespace meltfront::reference_fem::fitted

#endif
