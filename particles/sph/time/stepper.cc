#include <cases/temperature_slack.h>
#include <cases/time_integral.h>
#include <particles/sph/time/adaptive_stepper.h>
#include <particles/sph/time/explicit_stepper.h>
#include <particles/sph/time/implicit_stepper.h>
#include <particles/sph/time/stepper.h>

#include <cmath>
#include <limits>
#include <utility>

namespace meltfront::particles
{
  namespace
  {
    constexpr double bound_tolerance = 1e-9;
  } // namespace

  Stepper::Stepper(HeatFlow &heat_flow, const Discretisation &discretisation,
                   const StepPlan &plan, std::vector<double> initial, std::string method)
    : heat_flow(heat_flow)
    , dis(discretisation)
    , plan(plan)
    , n(initial.size())
    , method(std::move(method))
    , enthalpy(std::move(initial))
    , bounds(cases::temperature_bounds(dis.scene))
    , particle_mass(dis.particle_volume * dis.scene.material.solid.density)
  {
    enthalpy.resize(heat_flow.padded_size(), 0.);
    heat_flow.prepare_step(
        dis.scene.start_time,
        cases::end_of_piece(plan.ends, dis.scene.start_time, time_of(1)));
    heat_flow.hold_walls(0, enthalpy);
    follow();
  }

  void Stepper::follow()
  {
    dis.own.refresh(std::span(enthalpy).first(n));
    heat_flow.follow(enthalpy);
  }

  double Stepper::time_of(long step) const
  {
    return step == plan.steps ? dis.scene.end_time
                              : cases::snap_to_breakpoint(
                                  plan.ends, dis.scene.start_time + step * plan.step);
  }

  double Stepper::advance(long step, double begin)
  {
    const double end = make_step(step, begin);
    if(heat_flow.displaces_liquid())
      booked.add(heat_flow.displace(begin, end, enthalpy));
    check(step, end);
    return end;
  }

  double Stepper::finish()
  {
    const double dirichlet = heat_flow.hold_walls(1, enthalpy);
    follow();
    extremes = heat_flow.temperatures(enthalpy);
    return dirichlet;
  }

  void Stepper::book(double through_walls, double dirichlet)
  {
    booked.add(through_walls / dis.cross_section);
    booked.add(dirichlet);
  }

  bool Stepper::breaks_bounds() const
  {
    // Where a source leaves one bound only, the temperatures at hand set the scale.
    const double slack = 0.5
                         * cases::temperature_slack(bounds, bound_tolerance,
                                                    extremes.highest - extremes.lowest);
    return !extremes.finite || extremes.lowest < bounds.lower - slack
           || extremes.highest > bounds.upper + slack;
  }

  void Stepper::check(long step, double time) const
  {
    constexpr double broken = std::numeric_limits<double>::quiet_NaN();
    cases::check_temperature(bounds, extremes.finite ? extremes.lowest : broken,
                             extremes.finite ? extremes.highest : broken, method, step,
                             time, bound_tolerance);
  }

  std::unique_ptr<Stepper>
  make_stepper(const SphParameters &parameters, HeatFlow &heat_flow,
               const Discretisation &discretisation, const StepPlan &plan,
               std::vector<double> enthalpy, const std::string &method)
  {
    if(is_implicit(parameters.time_scheme))
      return std::make_unique<ImplicitStepper>(parameters, heat_flow, discretisation,
                                               plan, std::move(enthalpy), method);
    if(parameters.time_scheme == TimeScheme::automatic)
      return std::make_unique<AdaptiveStepper>(parameters, heat_flow, discretisation,
                                               plan, std::move(enthalpy), method);
    return std::make_unique<ExplicitStepper>(heat_flow, discretisation, plan,
                                             std::move(enthalpy), method);
  }
} // namespace meltfront::particles
