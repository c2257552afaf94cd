#include <cases/error.h>
#include <cases/scene.h>
#include <cases/time_integral.h>
#include <particles/sph/time/implicit_scheme.h>

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

  ImplicitScheme::ImplicitScheme(const SphParameters &parameters, const StepPlan &plan,
                                 const cases::Scene &scene, std::size_t fields,
                                 std::string method)
    : scheme(parameters.time_scheme)
    , wanted_error(parameters.step_error)
    , plan(plan)
    , start(scene.start_time)
    , last(scene.end_time)
    , breakpoints(cases::breakpoints_of(scene))
    , method(std::move(method))
    , next_step(plan.limits.monotone)
    , moved(fields, 0.)
    , change(fields, 0.)
  {
  }

  TimeScheme ImplicitScheme::scheme_of(long step, double begin) const
  {
    return step <= damped_steps || std::ranges::binary_search(breakpoints, begin)
               ? TimeScheme::backward_euler
               : scheme;
  }

  double ImplicitScheme::make_step(Subject &subject, long step, double begin,
                                   WallHeat &heat)
  {
    if(wanted_error > 0)
      return make_controlled_step(subject, step, begin, heat);
    const double end
        = step == plan.steps
              ? last
              : cases::snap_to_breakpoint(breakpoints, start + step * plan.step);
    while(begin < end)
    {
      const double next = cases::end_of_piece(plan.ends, begin, end);
      if(scheme_of(step, begin) != scheme)
      {
        const double middle = 0.5 * (begin + next);
        cross(subject, step, begin, middle, TimeScheme::backward_euler, 0, heat);
        cross(subject, step, middle, next, TimeScheme::backward_euler, 0, heat);
      }
      else
        cross(subject, step, begin, next, scheme, 0, heat);
      begin = next;
    }
    return end;
  }

  void ImplicitScheme::cross(Subject &subject, long step, double begin, double end,
                             TimeScheme with, int halvings, WallHeat &heat)
  {
    before = subject.state();
    WallHeat added;
    if(subject.attempt(begin, end, with, added))
    {
      heat.through += added.through;
      heat.dirichlet += added.dirichlet;
      return;
    }
    if(halvings == most_halvings)
      fail(step, end);
    std::swap(subject.state(), before);
    ++rejected;
    const double middle = 0.5 * (begin + end);
    cross(subject, step, begin, middle, TimeScheme::backward_euler, halvings + 1, heat);
    cross(subject, step, middle, end, TimeScheme::backward_euler, halvings + 1, heat);
  }

  double ImplicitScheme::compare(Subject &subject, double begin, double end,
                                 TimeScheme with, WallHeat &heat)
  {
    constexpr double failed = std::numeric_limits<double>::infinity();
    const double middle = 0.5 * (begin + end);
    before = subject.state();
    WallHeat of_whole;
    if(!subject.attempt(begin, end, with, of_whole))
      return failed;
    whole = subject.state();
    subject.state() = before;
    if(!subject.attempt(begin, middle, with, heat)
       || !subject.attempt(middle, end, with, heat))
      return failed;
    double largest = 0;
    for(std::size_t field = 0; field < moved.size(); ++field)
      largest = std::max(largest, compare_field(subject.state(), field));
    return largest;
  }

  double ImplicitScheme::compare_field(const std::vector<double> &state,
                                       std::size_t field)
  {
    const std::size_t length = state.size() / moved.size();
    double difference = 0, size = 0;
    change[field] = 0;
    for(std::size_t i = field * length; i < (field + 1) * length; ++i)
    {
      difference += std::abs(whole[i] - state[i]);
      change[field] += std::abs(state[i] - before[i]);
      size += std::abs(state[i]);
    }
    // Where hardly anything moves there is nothing to compare with but the state itself.
    constexpr double at_rest = 1e-5;
    const double scale = std::max(moved[field] + change[field], at_rest * size);
    return difference > 0 ? difference / scale : 0.;
  }

  double ImplicitScheme::make_controlled_step(Subject &subject, long step, double begin,
                                              WallHeat &heat)
  {
    const double shortest = 1e-12 * (last - start);
    const TimeScheme with = scheme_of(step, begin);
    const double order = with == TimeScheme::crank_nicolson ? 2 : 1;
    for(;;)
    {
      // No rest much shorter than the steps is left over.
      const double end = cases::end_of_piece(
          plan.ends, begin, begin + 1.01 * next_step >= last ? last : begin + next_step);
      WallHeat added;
      const double error = compare(subject, begin, end, with, added);
      constexpr double caution = 0.9, least = 0.2, most = 2;
      next_step = (end - begin)
                  * std::clamp(caution * std::pow(wanted_error / error, 1 / (order + 1)),
                               least, most);
      if(error <= wanted_error)
      {
        for(std::size_t field = 0; field < moved.size(); ++field)
          moved[field] += change[field];
        heat.through += added.through;
        heat.dirichlet += added.dirichlet;
        return end;
      }
      std::swap(subject.state(), before);
      ++rejected;
      if(next_step < shortest)
        fail(step, end);
    }
  }

  void ImplicitScheme::fail(long step, double time) const
  {
    throw cases::NumericalError(
        method, step, time, "enthalpy",
        "is not found by Newton's iteration, or not within its bounds, however short the "
        "implicit step");
  }
} // namespace meltfront::particles
