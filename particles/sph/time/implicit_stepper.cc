#include <particles/sph/time/implicit_stepper.h>

#include <utility>

namespace meltfront::particles
{
  ImplicitStepper::ImplicitStepper(const SphParameters &parameters, HeatFlow &heat_flow,
                                   const Discretisation &discretisation,
                                   const StepPlan &plan, std::vector<double> initial,
                                   const std::string &method)
    : Stepper(heat_flow, discretisation, plan, std::move(initial), method)
    , scheme(parameters, plan, discretisation.scene, 1, method)
    , implicit_flow(heat_flow, discretisation.scene.material, n)
    , solver(implicit_flow)
  {
  }

  StepCounts ImplicitStepper::counts() const
  {
    return {scheme.repeated(), solver.linear_iterations(), solver.most_iterations()};
  }

  double ImplicitStepper::make_step(long step, double begin)
  {
    WallHeat heat;
    const double end = scheme.make_step(*this, step, begin, heat);
    book(heat.through, heat.dirichlet);
    return end;
  }

  bool ImplicitStepper::attempt(double begin, double end, TimeScheme with, WallHeat &heat)
  {
    heat_flow.prepare_step(begin, end);
    const bool solved = solver.take_step(
        enthalpy, end - begin, with == TimeScheme::crank_nicolson, mass(),
        [this](std::span<double> dirichlet)
        { return heat_flow.hold_walls(1, dirichlet); },
        heat);
    heat.dirichlet += finish();
    return solved && !breaks_bounds();
  }
} // namespace meltfront::particles
