#include <reference_fem/fitted/events/approach.h>
#include <reference_fem/fitted/events/data_steps.h>
#include <reference_fem/fitted/events/timeline.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using dealii::Vector;

    /** The share of a ray at which a phase is about to break up where many rays are
     * followed, of which one arrives before the others: that is not simulated. */
    constexpr double thinnest_of_many = 1e-3;

    /** A front is approached that will reach an end within so many steps. */
    constexpr double steps_ahead = 2;

    /** The share of the time left to the end of the ray that a step of the approach
     * takes. */
    constexpr double approach = 0.8;

    /** More steps of an approach mean that the front never arrives. */
    constexpr int longest_approach = 1000;

    /** A wall that passes the melting temperature within so many steps of a segment does
     * so while steps and cells do not resolve how it gets there. */
    constexpr int early_steps = 4;

    /** Of the temperature scale: rounding of a wall at the melting temperature. */
    constexpr double at_melting = 1e-12;

    /** Refinements after which a wall is at the melting temperature from the start. */
    constexpr int most_refinements = 12;

    /** An approach is left when so many steps of the usual length are left to its end. */
    constexpr double steps_away = 6;

    /** Whether the front comes so close to an end of a ray that it breaks up there. */
    bool touches_end(const FittedProblem &problem, const AcceptedStep &step)
    {
      const RayMesh &mesh = problem.mesh();
      const double thin = thinnest_of_many * (mesh.outer - mesh.inner);
      for(unsigned int ray = 0; ray < mesh.surface.n_rays(); ++ray)
      {
        const unsigned int front = mesh.front_node(ray);
        const double h = step.u[front], rate = step.rate[front];
        if((rate < 0 && h - mesh.inner < thin) || (rate > 0 && mesh.outer - h < thin))
          return true;
      }
      return false;
    }

    /** Take the steps until one is not to be followed by another, which may be the last
     * of its range. */
    void advance(Integrator &integrator, const std::vector<StepRange> &ranges,
                 const Integrator::AfterStep &after_step)
    {
      bool goes_on = true;
      const auto watched
          = [&](const AcceptedStep &step) { return goes_on = after_step(step); };
      for(auto range = ranges.begin(); goes_on && range != ranges.end(); ++range)
        integrator.advance_to(range->end, range->step * (1 + 1e-9), watched);
    }

    /** Planned steps, none beyond an end. */
    std::vector<StepRange> steps_until(const std::vector<StepRange> &planned,
                                       const double end)
    {
      std::vector<StepRange> result;
      for(const StepRange &range : planned)
      {
        result.push_back({std::min(range.end, end), range.step});
        if(range.end >= end)
          break;
      }
      return result;
    }

    void add(const IntegrationCost &cost, IntegrationCost &total)
    {
      total.halved += cost.halved;
      total.repeated += cost.repeated;
      total.fallbacks += cost.fallbacks;
      total.starts += cost.starts;
      total.iterations += cost.iterations;
      total.most_iterations = std::max(total.most_iterations, cost.most_iterations);
      total.factorisations += cost.factorisations;
      total.work += cost.work;
    }
  } // namespace

  Timeline::Timeline(EventScene given, IntegrationOptions options, Listener listener)
    : setting(std::move(given))
    , options(std::move(options))
    , listener(std::move(listener))
    , phases(setting, this->options.method)
  {
  }

  void Timeline::run(RunSegment first)
  {
    std::optional<RunSegment> segment = std::move(first);
    const FittedProblem &problem = *segment->problem;
    begin(*segment);
    phases.start(problem, segment->time, segment->state);
    const bool has_front = problem.mesh().has_front();
    if(has_front)
      phases.check(problem, 0, segment->time, segment->state);
    listener.step(0, segment->time, segment->state, false);
    if(follows_events())
    {
      if(auto next = set_out(*segment, initial_layers(setting, *segment)))
        begin(*(segment = std::move(next)));
    }
    else
    {
      const double clock = problem.physics().clock.clock(segment->time);
      for(const WallCrossing &crossing :
          phases.wall_crossings(problem, clock, clock, segment->state))
        phases.refuse(crossing.inner, segment->time);
    }
    while((segment = integrate(*segment)))
      begin(*segment);
    total.steps = steps;
  }

  void Timeline::begin(const RunSegment &segment)
  {
    if(!segment.event.text.empty())
      happened.push_back(segment.event);
    listener.begin(segment);
  }

  IntegrationOptions Timeline::options_for(const RunSegment &segment) const
  {
    IntegrationOptions result = options;
    result.time = [clock = segment.problem->physics().clock](const double value)
    { return clock.time(value); };
    return result;
  }

  void Timeline::accept(const RunSegment &segment, const AcceptedStep &step, Point &point)
  {
    const Clock &clock = segment.problem->physics().clock;
    const double end = setting.scene.end_time;
    const bool last = step.clock == clock.clock(end);
    const double time = last ? end : clock.time(step.clock);
    try
    {
      phases.check(*segment.problem, ++steps, time, step.u);
    }
    catch(const cases::NumericalError &)
    {
      listener.find_cause(time, step.u);
      throw;
    }
    listener.step(steps, time, step.u, last);
    point = {step.clock, step.u, step.rate};
  }

  std::optional<RunSegment> Timeline::integrate(const RunSegment &segment)
  {
    const FittedProblem &problem = *segment.problem;
    const Clock &clock = problem.physics().clock;
    const double from = clock.clock(segment.time);
    const double jump = next_jump(segment.time), shift = beside_jump();
    const double end = clock.clock(std::min(jump - shift, setting.scene.end_time));
    const std::vector<StepRange> ranges
        = fit_to_data(steps_until(segment.steps, end), from, clock,
                      data_of(problem, segment.state), options.tolerance > 0);
    if(may_pass_early(segment))
      if(auto next = refined(segment, ranges))
        return next;
    Integrator integrator(problem, options_for(segment));
    integrator.start(from, segment.state);
    Point last{from, segment.state, Vector<double>(segment.state.size())};
    std::optional<RunSegment> next;
    while(!next && last.clock < end)
    {
      const Halt halt = take_planned_steps(segment, ranges, integrator, last);
      if(!halt.crossings.empty())
        next = pass_walls(segment, integrator, last, halt.crossings);
      else if(halt.shrinks)
        next = approach_end(segment, ranges, integrator, last);
    }
    add(integrator.cost(), total);
    if(!next && jump < setting.scene.end_time)
      next = after_jump(segment, jump + shift, last.u);
    return next;
  }

  Timeline::Halt Timeline::take_planned_steps(const RunSegment &segment,
                                              const std::vector<StepRange> &ranges,
                                              Integrator &integrator, Point &last)
  {
    const FittedProblem &problem = *segment.problem;
    Halt halt;
    const auto after_step = [&](const AcceptedStep &step)
    {
      halt.crossings = phases.wall_crossings(problem, last.clock, step.clock, step.u);
      if(!halt.crossings.empty() && !follows_events())
        phases.refuse(halt.crossings[0].inner,
                      problem.physics().clock.time(halt.crossings[0].clock));
      if(doubtful(problem, halt.crossings, last.u, last.rate, step.clock - last.clock))
      {
        halt = {{}, true};
        return false;
      }
      if(!halt.crossings.empty())
        return false;
      accept(segment, step, last);
      if(!follows_events() && touches_end(problem, step))
        throw cases::Refusal(fmt::format(
            "{} follows a front that reaches an end of the domain only along a line "
            "(symmetry other than none); here it does at t = {:.6g}",
            options.method, problem.physics().clock.time(step.clock)));
      halt.shrinks
          = follows_events()
            && soonest(problem, last.u, last.rate).remaining < steps_ahead * step.size;
      return !halt.shrinks;
    };
    if(integrator.clock() != last.clock)
      integrator.start(last.clock, last.u);
    bool goes_on = true;
    for(auto range = ranges.begin(); goes_on && range != ranges.end(); ++range)
      if(range->end > last.clock)
        integrator.advance_to(range->end, range->step * (1 + 1e-9),
                              [&](const AcceptedStep &step)
                              { return goes_on = after_step(step); });
    return halt;
  }

  bool Timeline::may_pass_early(const RunSegment &segment) const
  {
    const FittedProblem &problem = *segment.problem;
    const RayMesh &mesh = problem.mesh();
    if(!follows_events() || !mesh.has_front())
      return follows_events();
    const Physics &physics = problem.physics();
    for(const bool inner : {true, false})
    {
      const cases::Boundary &wall = inner ? physics.inner_wall : physics.outer_wall;
      if((inner && mesh.has_centre()) || !cases::prescribes_heat(wall.kind))
        continue;
      const bool solid = problem.phase(inner ? 0 : mesh.n_fronts()).solid;
      const double flux
          = cases::heat_through(wall, mesh.position(0, inner ? mesh.inner : mesh.outer),
                                segment.time, physics.melting_temperature)
                .flux;
      if(solid ? flux > 0 : flux < 0)
        return true;
    }
    return false;
  }

  std::optional<RunSegment> Timeline::refined(const RunSegment &segment,
                                              const std::vector<StepRange> &given)
  {
    std::optional<RunSegment> finer;
    std::vector<StepRange> ranges = given;
    for(int k = 0; k < most_refinements; ++k)
    {
      const RunSegment &present = finer ? *finer : segment;
      const FittedProblem &problem = *present.problem;
      const Clock &clock = problem.physics().clock;
      Integrator trial(problem, options_for(present));
      trial.start(clock.clock(present.time), present.state);
      double before = trial.clock();
      std::vector<WallCrossing> crossings;
      int tried = 0;
      const auto after_step = [&](const AcceptedStep &step)
      {
        crossings = phases.wall_crossings(problem, before, step.clock, step.u);
        before = step.clock;
        return crossings.empty() && ++tried < early_steps;
      };
      advance(trial, ranges, after_step);
      add(trial.cost(), total);
      // A wall that is at the melting temperature starts its front at once.
      std::erase_if(crossings,
                    [&](const WallCrossing &crossing)
                    {
                      return std::abs(problem.wall_excess(crossing.inner, 0, present.time,
                                                          present.state))
                             <= at_melting * problem.physics().temperature_scale;
                    });
      if(crossings.empty())
        return finer;
      finer = refined_stretch(setting, present, crossings[0].inner,
                              clock.time(crossings[0].clock) - present.time);
      ranges = fit_to_data(finer->steps, 0, finer->problem->physics().clock,
                           data_of(*finer->problem, finer->state), options.tolerance > 0);
    }
    throw cases::Refusal(fmt::format(
        "fem-fitted cannot start a front at a wall that is at the melting temperature "
        "already and is led beyond it (t = {:.6g})",
        segment.time));
  }

  std::optional<RunSegment> Timeline::approach_end(const RunSegment &segment,
                                                   const std::vector<StepRange> &ranges,
                                                   Integrator &integrator, Point &last)
  {
    const FittedProblem &problem = *segment.problem;
    const Clock &clock = problem.physics().clock;
    const double end = ranges.back().end;
    Approach state = soonest(problem, last.u, last.rate);
    std::vector<WallCrossing> crossings;
    bool too_long = false;
    double step = std::min(1e-3 * (end - last.clock), approach * state.remaining);
    const auto after_step = [&](const AcceptedStep &accepted)
    {
      crossings = phases.wall_crossings(problem, last.clock, accepted.clock, accepted.u);
      too_long = doubtful(problem, crossings, last.u, last.rate, accepted.size);
      if(!too_long && crossings.empty())
      {
        accept(segment, accepted, last);
        state = soonest(problem, last.u, last.rate);
      }
      return false;
    };
    integrator.start(last.clock, last.u);
    auto range = ranges.begin();
    for(int k = 0; k < longest_approach && last.clock < end; ++k)
    {
      while(range->end <= last.clock)
        ++range;
      integrator.advance_to(std::min(range->end, last.clock + step), step, after_step);
      if(too_long)
      {
        integrator.start(last.clock, last.u);
        step /= 4;
        continue;
      }
      if(!crossings.empty())
        return pass_walls(segment, integrator, last, crossings);
      if(has_vanished(problem.mesh(), state))
        return remaining_stretch(setting, segment, clock.time(last.clock), last.u,
                                 state.interval);
      if(state.remaining > steps_away * range->step)
        return std::nullopt;
      step = std::min({approach * state.remaining, 2 * step, range->step});
    }
    if(last.clock < end)
      throw cases::NumericalError(options.method, steps, clock.time(last.clock),
                                  "a phase", "comes close to its end and stays there");
    return std::nullopt;
  }
} // namespace meltfront::reference_fem::fitted
