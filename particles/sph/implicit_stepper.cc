#include <cases/error.h>
#include <particles/sph/implicit_stepper.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meltfront::particles
{
  namespace
  {
    /** So many first steps of Crank-Nicolson are replaced by backward Euler. */
    constexpr long damped_steps = 2;

    /** A step that fails is halved so often. */
    constexpr int most_halvings = 12;
  } // namespace

  ImplicitStepper::ImplicitStepper(const SphParameters &parameters, HeatFlow &heat_flow,
                                   const Discretisation &discretisation,
                                   const StepPlan &plan, std::vector<double> initial,
                                   const std::string &method)
    : Stepper(heat_flow, discretisation, plan, std::move(initial), method)
    , scheme(parameters.time_scheme)
    , wanted_error(parameters.step_error)
    , next_step(plan.monotone)
    , solver(heat_flow, discretisation.scene.material)
  {
    for(auto *array : {&base, &flow, &before})
      array->resize(enthalpy.size());
    if(wanted_error > 0)
      whole.resize(enthalpy.size());
  }

  StepCounts ImplicitStepper::counts() const
  {
    return {repeated, solver.linear_iterations(), most_iterations};
  }

  TimeScheme ImplicitStepper::scheme_of(long step) const
  {
    return step <= damped_steps ? TimeScheme::backward_euler : scheme;
  }

  double ImplicitStepper::make_step(long step, double begin)
  {
    if(wanted_error > 0)
      return make_controlled_step(step, begin);
    const double end = time_of(step);
    WallHeat heat;
    if(scheme_of(step) != scheme)
    {
      const double middle = 0.5 * (begin + end);
      cross(step, begin, middle, TimeScheme::backward_euler, 0, heat);
      cross(step, middle, end, TimeScheme::backward_euler, 0, heat);
    }
    else
      cross(step, begin, end, scheme, 0, heat);
    book(heat.through, heat.held);
    return end;
  }

  void ImplicitStepper::cross(long step, double begin, double end, TimeScheme with,
                              int halvings, WallHeat &heat)
  {
    before = enthalpy;
    WallHeat added;
    if(attempt(begin, end, with, added))
    {
      heat.through += added.through;
      heat.held += added.held;
      return;
    }
    if(halvings == most_halvings)
      fail(step, end);
    std::swap(enthalpy, before);
    ++repeated;
    const double middle = 0.5 * (begin + end);
    cross(step, begin, middle, TimeScheme::backward_euler, halvings + 1, heat);
    cross(step, middle, end, TimeScheme::backward_euler, halvings + 1, heat);
  }

  bool ImplicitStepper::attempt(double begin, double end, TimeScheme with, WallHeat &heat)
  {
    heat_flow.prepare_step(begin, end);
    const bool trapezoidal = with == TimeScheme::crank_nicolson;
    const double weight = trapezoidal ? 0.5 : 1.;
    const double duration = weight * (end - begin);
    const double factor = enthalpy_factor(duration);
    base = enthalpy;
    if(trapezoidal)
    {
      heat_flow.follow(enthalpy);
      heat.through
          += duration * heat_flow.scale() * heat_flow.evaluate(enthalpy, 0, flow);
      for(std::size_t a = 0; a < n; ++a)
        base[a] += factor * flow[a];
    }
    heat.held += heat_flow.hold_walls(1, base);
    heat_flow.hold_walls(1, enthalpy);
    const ImplicitSolver::Outcome outcome
        = solver.solve({std::span(base).first(n), factor, 1.}, enthalpy);
    most_iterations = std::max<long>(most_iterations, outcome.iterations);
    heat.through += duration * heat_flow.scale() * outcome.through_walls;
    heat.held += finish();
    return outcome.converged && !breaks_bounds();
  }

  double ImplicitStepper::compare(double begin, double end, TimeScheme with,
                                  WallHeat &heat)
  {
    constexpr double failed = std::numeric_limits<double>::infinity();
    const double middle = 0.5 * (begin + end);
    before = enthalpy;
    WallHeat of_whole;
    if(!attempt(begin, end, with, of_whole))
      return failed;
    whole = enthalpy;
    enthalpy = before;
    if(!attempt(begin, middle, with, heat) || !attempt(middle, end, with, heat))
      return failed;
    double difference = 0, size = 0;
    change = 0;
    for(std::size_t a = 0; a < n; ++a)
    {
      difference += std::abs(whole[a] - enthalpy[a]);
      change += std::abs(enthalpy[a] - before[a]);
      size += std::abs(enthalpy[a]);
    }
    // Where hardly anything moves there is nothing to compare with but the state itself.
    constexpr double at_rest = 1e-5;
    const double scale = std::max(moved + change, at_rest * size);
    return difference > 0 ? difference / scale : 0.;
  }

  double ImplicitStepper::make_controlled_step(long step, double begin)
  {
    const double last = dis.scene.end_time;
    const double shortest = 1e-12 * (last - dis.scene.start_time);
    const TimeScheme with = scheme_of(step);
    const double order = with == TimeScheme::crank_nicolson ? 2 : 1;
    for(;;)
    {
      // No rest much shorter than the steps is left over.
      const double end = begin + 1.01 * next_step >= last ? last : begin + next_step;
      WallHeat heat;
      const double error = compare(begin, end, with, heat);
      constexpr double caution = 0.9, least = 0.2, most = 2;
      next_step = (end - begin)
                  * std::clamp(caution * std::pow(wanted_error / error, 1 / (order + 1)),
                               least, most);
      if(error <= wanted_error)
      {
        moved += change;
        book(heat.through, heat.held);
        return end;
      }
      std::swap(enthalpy, before);
      ++repeated;
      if(next_step < shortest)
        fail(step, end);
    }
  }

  void ImplicitStepper::fail(long step, double time) const
  {
    throw cases::NumericalError(
        method, step, time, "enthalpy",
        "is not found by Newton's iteration, or not within its bounds, however short the "
        "implicit step");
  }
} // namespace meltfront::particles
