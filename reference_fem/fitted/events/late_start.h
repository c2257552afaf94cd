#ifndef meltfront_reference_fem_fitted_events_late_start_h
#define meltfront_reference_fem_fitted_events_late_start_h

#include <reference_fem/fitted/events/layered_state.h>
#include <reference_fem/fitted/time/integrator.h>

namespace meltfront::reference_fem::fitted
{
  /** A wall that is at the melting temperature at a time (s) and is led beyond it. */
  struct WallPassing
  {
    bool inner = true;
    double time = 0;
    /** It was there when the segment began, and leads_at_once(). */
    bool at_once = false;
  };

  /** Whether a wall of given flux or heat transfer that is at the melting temperature
   * leads more heat than the phase at it conducts, so that a front starts at once and no
   * layer of heat announces it. */
  bool leads_at_once(const FittedProblem &problem, bool inner, double time,
                     const dealii::Vector<double> &u);

  /** How long after a wall has passed the melting temperature a front is seeded (s). */
  double time_of_seed(const EventScene &setting, const RunSegment &past,
                      const WallPassing &passing);

  /**
   * The run from the moment at which one wall has passed the melting temperature, or both
   * have.
   *
   * The solution without new fronts, continued for a time tau beyond that moment, has a
   * wall that is D beyond the melting temperature. Held at it instead, the old phase
   * loses or gains the heat of a ramp, 4 D i^2erfc(x/(2 sqrt(a tau))) (Carslaw & Jaeger
   * 1959, section 2.5) with its images in the next front, to latent heat: behind a wall
   * of given flux the front is where the heat balances, s = 4 k D sqrt(tau)/(3 rho L
   * sqrt(pi a)) to leading order; before one of given temperature at s = v tau with
   * rho L v^2 + q v = k_new D/tau, q the flux out of the old phase. The new phase has a
   * linear profile. Where a wall at the melting temperature leads more heat at once, the
   * old phase stays as it is, and the front takes up what is left of the flux f,
   * rho L v = |f| - q.
   *
   * @param passings in the order of time
   * @param u        at the last of them
   * @param tau      after that (s)
   * @throws Refusal where the phase at the wall is too thin for another to start in it
   */
  RunSegment late_stretch(const EventScene &setting, const RunSegment &past,
                          const std::vector<WallPassing> &passings, double tau,
                          const dealii::Vector<double> &u,
                          const IntegrationOptions &integration);
} // namespace meltfront::reference_fem::fitted

#endif
