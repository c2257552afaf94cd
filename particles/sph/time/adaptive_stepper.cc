#include <cases/error.h>
#include <cases/time_integral.h>
#include <particles/sph/time/adaptive_stepper.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meltfront::particles
{
  namespace
  {
    /** What is left until a kink, over the step, that is not worth a step of its own. */
    constexpr double negligible = 0.01;

    /** Of steps that an error foretells. */
    constexpr double caution = 0.9;

    /** Length of the step after a kink, in explicit ones: what has ceased to melt cools
     * or warms within the time that heat takes to cross a particle. */
    constexpr double after_kink = 8;

    double span_of_enthalpy(const cases::Scene &scene)
    {
      const cases::TemperatureBounds bounds = cases::temperature_bounds(scene);
      const cases::Material &m = scene.material;
      return std::isfinite(bounds.upper - bounds.lower)
                 ? m.enthalpy(bounds.upper) - m.enthalpy(bounds.lower)
                 : 0.;
    }
  } // namespace

  AdaptiveStepper::AdaptiveStepper(const SphParameters &parameters, HeatFlow &heat_flow,
                                   const Discretisation &discretisation,
                                   const StepPlan &plan, std::vector<double> initial,
                                   const std::string &method)
    : Stepper(heat_flow, discretisation, plan, std::move(initial), method)
    , wanted_error(parameters.step_error)
    , explicit_step(plan.step)
    , longest((dis.scene.end_time - dis.scene.start_time) / fewest_steps)
    , next_step(plan.step)
    , jump(dis.scene.material.curves ? dis.scene.material.curves->jump()
                                     : dis.scene.material.latent_heat)
    , heat_span(std::max(jump, span_of_enthalpy(dis.scene)))
    , front_at_rest(std::pow(double(n), 1 - 1. / dis.dimension))
    , explicit_scheme(n, enthalpy.size(), heat_flow.threads())
    , newton_work(work_of_newton_iteration(heat_flow.half_bandwidth()))
    , last_newton(usual_newton_iterations)
    , before(enthalpy.size())
    , flow(enthalpy.size())
    , end_flow(enthalpy.size())
  {
    if(heat_flow.half_bandwidth() == 0)
      return;
    implicit_flow.emplace(heat_flow, dis.scene.material, n);
    solver.emplace(*implicit_flow);
  }

  StepCounts AdaptiveStepper::counts() const
  {
    StepCounts result{repeated, 0, 0};
    if(solver)
    {
      result.linear_iterations = solver->linear_iterations();
      result.most_iterations = solver->most_iterations();
    }
    return result;
  }

  double AdaptiveStepper::make_step(long step, double begin)
  {
    double end = aim(begin);
    bool by_euler = false, at_kink = ends_at_kink;
    for(;;)
    {
      const double duration = end - begin;
      before = enthalpy;
      const Trial trial = attempt(begin, end, by_euler);
      const bool shortest = duration <= explicit_step * (1 + 1e-12);
      if(by_euler || (trial.sound && (trial.error <= wanted_error || shortest)))
      {
        choose_next_step(duration, trial);
        if(at_kink)
          next_step = std::min(next_step, after_kink * explicit_step);
        std::swap(flow, end_flow);
        book(trial.through_walls, trial.dirichlet);
        return end;
      }
      ++repeated;
      const double kink = solver && trial.sound && !at_kink ? first_kink_crossed() : 1;
      at_kink = kink < 1;
      std::swap(enthalpy, before);
      follow();
      by_euler = shortest;
      if(at_kink)
        end = begin + kink * duration;
      else
      {
        next_step = duration
                    * (trial.sound ? std::clamp(
                           caution * std::sqrt(wanted_error / trial.error), 0.1, 0.9)
                                   : 0.25);
        end = aim(begin);
        at_kink = ends_at_kink;
      }
      if(end - begin < 1e-14 * (dis.scene.end_time - dis.scene.start_time))
        throw cases::NumericalError(method, step, end, "enthalpy",
                                    "is not found however short the step");
    }
  }

  void AdaptiveStepper::choose_next_step(double duration, const Trial &trial)
  {
    double factor = caution * std::sqrt(wanted_error / trial.error);
    // The trend of the error over the last two steps goes on (Gustafsson 1994).
    if(last_error > 0 && trial.error > 0)
      factor *= std::clamp(duration / last_duration * std::sqrt(last_error / trial.error),
                           0.5, 3.);
    last_error = trial.error;
    last_duration = duration;
    factor = std::clamp(factor, 0.2, 5.);
    // A step that ends early for another reason does not shorten the next.
    const bool cut = duration < 0.99 * next_step && factor >= 1;
    next_step = cut ? std::max(next_step, factor * duration) : factor * duration;
  }

  double AdaptiveStepper::aim(double begin)
  {
    double duration = std::clamp(next_step, explicit_step, longest);
    ends_at_kink = false;
    if(solver)
    {
      const double kink = time_to_kink(duration);
      ends_at_kink = kink < duration;
      if(ends_at_kink)
        duration = kink;
      else if(kink < 2 * duration)
        duration = 0.5 * kink;
    }
    const double last = dis.scene.end_time;
    return cases::end_of_piece(plan.ends, begin,
                               begin + 1.01 * duration >= last ? last : begin + duration);
  }

  double AdaptiveStepper::time_to_kink(double step) const
  {
    double soonest = std::numeric_limits<double>::infinity();
    const double least_change = negligible * wanted_error * heat_span;
    const double rate_of_flow = heat_flow.scale() / mass();
    for(std::size_t a = 0; a < n; ++a)
    {
      const double h = enthalpy[a], rate = rate_of_flow * flow[a];
      const double kink = rate > 0 ? (h < 0 ? 0. : jump) : (h > jump ? jump : 0.);
      const double time = (kink - h) / rate;
      if(time >= negligible * step && time < soonest
         && std::abs(rate) * step > least_change && changes_phase(a))
        soonest = time;
    }
    return soonest;
  }

  bool AdaptiveStepper::changes_phase(std::size_t a) const
  {
    const double h = enthalpy[a];
    if(h >= 0 && h <= jump)
      return true;
    const std::size_t reach = heat_flow.half_bandwidth();
    for(std::size_t b = a - std::min(a, reach); b <= std::min(a + reach, n - 1); ++b)
      if(h < 0 ? enthalpy[b] > jump : enthalpy[b] < 0)
        return true;
    return false;
  }

  double AdaptiveStepper::first_kink_crossed() const
  {
    double first = 1;
    for(std::size_t a = 0; a < n; ++a)
    {
      const double from = before[a], to = enthalpy[a];
      for(const double kink : {0., jump})
        if((from - kink) * (to - kink) < 0)
          if(const double share = (kink - from) / (to - from); share > negligible)
            first = std::min(first, share);
    }
    return first;
  }

  AdaptiveStepper::Trial AdaptiveStepper::attempt(double begin, double end, bool by_euler)
  {
    heat_flow.prepare_step(begin, end);
    const double duration = end - begin;
    const int stages = stages_reaching(duration / explicit_step);
    Trial trial{true, 0, 0, 0};
    if(by_euler)
      step_by_euler(duration, trial);
    else if(solver && stages + 1 > last_newton * newton_work)
      step_implicitly(duration, trial);
    else
      step_explicitly(duration, stages, trial);
    trial.sound = trial.sound && !breaks_bounds();
    if(trial.sound)
      trial.error = error_of(duration);
    return trial;
  }

  void AdaptiveStepper::step_explicitly(double duration, int stages, Trial &trial)
  {
    explicit_scheme.use_stages(stages);
    trial.through_walls = explicit_scheme.take_super_step(
        enthalpy, duration, heat_flow.scale(), mass(), [this] { follow(); },
        [this](double fraction, std::vector<double> &into)
        { return heat_flow.evaluate(enthalpy, fraction, into); });
    trial.dirichlet = finish();
    heat_flow.evaluate(enthalpy, 1., end_flow);
  }

  void AdaptiveStepper::step_by_euler(double duration, Trial &trial)
  {
    trial.through_walls = explicit_scheme.take_euler_steps(
        enthalpy, duration, 1, heat_flow.scale(), mass(), [this] { follow(); },
        [this](double fraction, std::vector<double> &into)
        { return heat_flow.evaluate(enthalpy, fraction, into); });
    trial.dirichlet = finish();
    heat_flow.evaluate(enthalpy, 1., end_flow);
  }

  void AdaptiveStepper::step_implicitly(double duration, Trial &trial)
  {
    WallHeat heat;
    const long iterations = solver->newton_iterations();
    trial.sound = solver->take_two_stage_step(
        enthalpy, duration, mass(),
        [this](double fraction, std::span<double> held)
        { return heat_flow.hold_walls(fraction, held); },
        heat);
    last_newton = static_cast<double>(solver->newton_iterations() - iterations) + 2;
    ++implicit_steps;
    trial.through_walls = heat.through;
    trial.dirichlet = heat.dirichlet + finish();
    std::ranges::copy(solver->last_flow(), end_flow.begin());
  }

  double AdaptiveStepper::error_of(double duration)
  {
    const double factor = duration * heat_flow.scale() / mass();
    double sum = 0, lowest = enthalpy[0], highest = enthalpy[0];
    long melting = 0;
    for(std::size_t a = 0; a < n; ++a)
    {
      const double h = enthalpy[a];
      sum += std::abs(h - before[a] - factor * end_flow[a]);
      lowest = std::min(lowest, h);
      highest = std::max(highest, h);
      melting += (h > 0) & (h < jump);
    }
    // Walls set these.
    for(const std::uint32_t a : dis.dirichlet)
      sum -= std::abs(enthalpy[a] - before[a] - factor * end_flow[a]);
    heat_span = std::max(heat_span, highest - lowest);
    const double front = melting > 0 ? double(melting) : front_at_rest;
    return sum > 0 ? sum / (heat_span * front) : 0.;
  }
} // namespace meltfront::particles
