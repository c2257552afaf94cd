#include <cases/time_integral.h>
#include <particles/sph/time/explicit_stepper.h>

#include <utility>

namespace meltfront::particles
{
  ExplicitStepper::ExplicitStepper(HeatFlow &heat_flow,
                                   const Discretisation &discretisation,
                                   const StepPlan &plan, std::vector<double> initial,
                                   const std::string &method)
    : Stepper(heat_flow, discretisation, plan, std::move(initial), method)
    , scheme(plan, n, enthalpy.size(), heat_flow.threads())
  {
  }

  double ExplicitStepper::make_step(long step, double begin)
  {
    const double end = time_of(step);
    while(begin < end)
    {
      const double next = cases::end_of_piece(plan.ends, begin, end);
      cross(step, begin, next);
      begin = next;
    }
    return end;
  }

  void ExplicitStepper::cross(long step, double begin, double end)
  {
    heat_flow.prepare_step(begin, end);
    const bool super = plan.stages > 1 && step > plan.resolved_steps;
    double wall_heat
        = super ? scheme.take_super_step(
              enthalpy, end - begin, heat_flow.scale(), mass(), [this] { follow(); },
              [this](double fraction, std::vector<double> &flow)
              { return heat_flow.evaluate(enthalpy, fraction, flow); })
                : euler_steps(end - begin);
    double dirichlet_heat = finish();
    if(super && breaks_bounds())
    {
      scheme.restore(enthalpy);
      follow();
      wall_heat = euler_steps(end - begin);
      dirichlet_heat = finish();
      ++repeated;
    }
    book(wall_heat, dirichlet_heat);
  }

  double ExplicitStepper::euler_steps(double duration)
  {
    return scheme.take_euler_steps(
        enthalpy, duration, plan.euler_substeps, heat_flow.scale(), mass(),
        [this] { follow(); },
        [this](double fraction, std::vector<double> &flow)
        { return heat_flow.evaluate(enthalpy, fraction, flow); });
  }
} // namespace meltfront::particles
