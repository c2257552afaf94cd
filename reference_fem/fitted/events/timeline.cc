#include <reference_fem/fitted/events/data_steps.h>
#include <reference_fem/fitted/events/profile.h>
#include <reference_fem/fitted/events/timeline.h>

#include <cases/error.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using dealii::Vector;

    /** The share of a ray, at its centre of the volume, at which a phase is dropped: less
     * than that is lost in the rounding of the heat of all. */
    constexpr double thinnest = 1e-9;

    /** The same where many rays are followed, of which one arrives before the others: how
     * a phase breaks up is not simulated. */
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

    /** Refinements after which a wall is at the melting temperature from the start. */
    constexpr int most_refinements = 12;

    /** A wall that is so shortly after it has passed the melting temperature, of the time
     * to the seed, as far off it as this share of what it is at the seed, has jumped. */
    constexpr double shortly = 1e-3, already = 0.1;

    /** Shortest step of an approach, of the run. */
    constexpr double shortest = 1e-13;

    double thinnest_share(const RayMesh &mesh, const bool to_inner)
    {
      return to_inner && mesh.has_centre()
                 ? std::pow(thinnest, 1. / (mesh.surface.exponent + 1))
                 : thinnest;
    }

    /** How far a front is from the end that it moves to, and for how long. */
    struct Approach
    {
      bool to_inner = false;
      double distance = 0, remaining = 0; ///< m, on the clock
    };

    Approach approach_of(const FittedProblem &problem, const Vector<double> &u,
                         const double rate)
    {
      const RayMesh &mesh = problem.mesh();
      const double h = u[mesh.front_node(0)];
      Approach result;
      result.to_inner = rate < 0;
      result.distance = result.to_inner ? h - mesh.inner : mesh.outer - h;
      result.remaining = result.distance / std::max(std::abs(rate), 1e-300);
      // To a centre it is the volume within that shrinks evenly, or faster.
      if(result.to_inner && mesh.has_centre())
        result.remaining /= mesh.surface.exponent + 1;
      return result;
    }

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
    const HeatContent heat = first.problem->heat(first.time, first.state);
    std::optional<RunSegment> segment = std::move(first);
    begin(*segment);
    phases.start(*segment->problem, segment->time, segment->state);
    const bool one_phase = !segment->problem->mesh().has_front();
    if(!one_phase)
      phases.check(*segment->problem, 0, segment->time, segment->state);
    listener.step(0, segment->time, segment->state, false);
    if(one_phase)
    {
      const OnePhase initial = initial_phase(setting, heat.sensible + heat.latent);
      if(const auto start = sudden_start(setting, initial))
      {
        segment = seeded_stretch(setting, *start, initial);
        begin(*segment);
      }
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

  void Timeline::accept(const RunSegment &segment, const AcceptedStep &step)
  {
    const Clock &clock = segment.problem->physics().clock;
    const double end = setting.scene.end_time;
    const bool last = step.clock == clock.clock(end);
    const double time = last ? end : clock.time(step.clock);
    phases.check(*segment.problem, ++steps, time, step.u);
    listener.step(steps, time, step.u, last);
  }

  std::optional<RunSegment> Timeline::integrate(const RunSegment &segment)
  {
    const FittedProblem &problem = *segment.problem;
    const Clock &clock = problem.physics().clock;
    const double from = clock.clock(segment.time);
    const std::vector<StepRange> ranges
        = fit_to_data(segment.steps, from, clock, data_of(problem, segment.state),
                      options.tolerance > 0);
    const bool has_front = problem.mesh().has_front();
    if(!has_front)
      if(auto next = refined(segment, ranges))
        return next;
    Integrator integrator(problem, options_for(segment));
    integrator.start(from, segment.state);
    std::optional<RunSegment> next = has_front
                                         ? integrate_front(segment, ranges, integrator)
                                         : integrate_phase(segment, ranges, integrator);
    add(integrator.cost(), total);
    return next;
  }

  std::optional<RunSegment>
  Timeline::integrate_phase(const RunSegment &segment,
                            const std::vector<StepRange> &ranges, Integrator &integrator)
  {
    Point before{integrator.clock(), segment.state, 0};
    std::optional<WallCrossing> crossing;
    const auto after_step = [&](const AcceptedStep &step)
    {
      crossing = phases.wall_crossing(*segment.problem, before.clock, step.clock, step.u);
      if(crossing)
        return false;
      accept(segment, step);
      before = {step.clock, step.u, 0};
      return true;
    };
    advance(integrator, ranges, after_step);
    return crossing ? cross_wall(segment, integrator, before, *crossing) : std::nullopt;
  }

  std::optional<RunSegment>
  Timeline::integrate_front(const RunSegment &segment,
                            const std::vector<StepRange> &ranges, Integrator &integrator)
  {
    const FittedProblem &problem = *segment.problem;
    const unsigned int front = problem.mesh().front_node(0);
    const bool followed = setting.options.dimension == 1;
    Point last{integrator.clock(), segment.state, 0};
    bool arrives = false;
    const auto after_step = [&](const AcceptedStep &step)
    {
      const auto crossing = phases.wall_crossing(problem, last.clock, step.clock, step.u);
      // A phase may vanish at a wall at the time at which that passes the melting
      // temperature: the step was too long.
      if(crossing && followed && last.front_rate != 0
         && approach_of(problem, last.u, last.front_rate).to_inner == crossing->inner)
      {
        arrives = true;
        return false;
      }
      if(crossing)
        phases.refuse(problem, crossing->inner,
                      problem.physics().clock.time(crossing->clock));
      accept(segment, step);
      last = {step.clock, step.u, step.rate[front]};
      if(!followed && touches_end(problem, step))
        throw cases::Refusal(fmt::format(
            "{} follows a front that reaches an end of the domain only along a line "
            "(symmetry other than none); here it does at t = {:.6g}",
            options.method, problem.physics().clock.time(step.clock)));
      arrives = followed
                && approach_of(problem, last.u, last.front_rate).remaining
                       < steps_ahead * step.size;
      return !arrives;
    };
    advance(integrator, ranges, after_step);
    if(!arrives || !(last.clock < problem.physics().clock.clock(setting.scene.end_time)))
      return std::nullopt;
    return approach_end(segment, ranges, integrator, last);
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
      std::optional<WallCrossing> crossing;
      int tried = 0;
      const auto after_step = [&](const AcceptedStep &step)
      {
        crossing = phases.wall_crossing(problem, before, step.clock, step.u);
        before = step.clock;
        return !crossing && ++tried < early_steps;
      };
      advance(trial, ranges, after_step);
      add(trial.cost(), total);
      if(!crossing)
        return finer;
      finer = refined_stretch(setting, present, crossing->inner,
                              clock.time(crossing->clock) - present.time);
      ranges = fit_to_data(finer->steps, 0, finer->problem->physics().clock,
                           data_of(*finer->problem, finer->state), options.tolerance > 0);
    }
    throw cases::Refusal(fmt::format(
        "fem-fitted cannot start a front at a wall that is at the melting temperature "
        "already and is led beyond it (t = {:.6g})",
        segment.time));
  }

  std::optional<RunSegment> Timeline::cross_wall(const RunSegment &segment,
                                                 Integrator &integrator,
                                                 const Point &before,
                                                 const WallCrossing &crossing)
  {
    const FittedProblem &problem = *segment.problem;
    const Clock &clock = problem.physics().clock;
    const bool inner = crossing.inner;
    const auto excess_at = [&](const double end)
    {
      integrator.start(before.clock, before.u);
      integrator.advance_to(end, crossing.clock - before.clock);
      return problem.wall_excess(inner, 0, clock.time(end), integrator.state());
    };
    const double at_start
        = problem.wall_excess(inner, 0, clock.time(before.clock), before.u),
        at_end = excess_at(crossing.clock);
    double lower = before.clock, upper = before.clock;
    // A step may end on the melting temperature, up to rounding.
    if(at_start * at_end < 0)
    {
      std::uintmax_t iterations = 100;
      std::tie(lower, upper) = boost::math::tools::toms748_solve(
          [&](const double end)
          { return end == before.clock ? at_start : excess_at(end); },
          before.clock, crossing.clock, at_start, at_end,
          boost::math::tools::eps_tolerance<double>(50), iterations);
    }
    const double time = clock.time(0.5 * (lower + upper));
    if(has_jumped(segment, time, inner))
    {
      excess_at(lower);
      return after_jump(segment, clock.time(upper), integrator.state(), inner);
    }
    excess_at(0.5 * (lower + upper));
    return late_stretch(setting, segment, time, integrator.state(), inner,
                        options_for(segment));
  }

  bool Timeline::has_jumped(const RunSegment &segment, const double time,
                            const bool inner) const
  {
    const FittedProblem &problem = *segment.problem;
    const Physics &physics = problem.physics();
    const cases::Boundary &wall = inner ? physics.inner_wall : physics.outer_wall;
    if(wall.kind != cases::BoundaryKind::fixed_temperature)
      return false;
    const RayMesh &mesh = problem.mesh();
    const double since = time_of_seed(setting, segment, time);
    const auto excess_after = [&](const double share)
    {
      return std::abs(wall.value(mesh.position(0, inner ? mesh.inner : mesh.outer),
                                 time + share * since)
                      - physics.melting_temperature);
    };
    return excess_after(shortly) > already * excess_after(1);
  }

  std::optional<RunSegment> Timeline::after_jump(const RunSegment &segment,
                                                 const double time,
                                                 const Vector<double> &u,
                                                 const bool inner)
  {
    const FittedProblem &problem = *segment.problem;
    const Profile profile(problem, u);
    const HeatContent heat = problem.heat(time, u);
    OnePhase state;
    state.time = time;
    state.temperature = [&](const double r)
    { return problem.physics().melting_temperature + profile.value(r); };
    state.solid = problem.physics().phases[0].solid;
    state.heat = heat.sensible + heat.latent;
    state.before = segment.before;
    state.before.walls += heat.walls;
    state.before.sources += heat.sources;
    const auto start = start_at_wall(setting, state, inner);
    if(!start || problem.physics().power)
      throw cases::Refusal(fmt::format("fem-fitted cannot start a front at the wall {}, "
                                       "which jumps across the melting "
                                       "temperature at t = {:.6g}",
                                       to_string(side_at(setting.scene, inner)), time));
    return seeded_stretch(setting, *start, state);
  }

  std::optional<RunSegment> Timeline::approach_end(const RunSegment &segment,
                                                   const std::vector<StepRange> &ranges,
                                                   Integrator &integrator, Point last)
  {
    const FittedProblem &problem = *segment.problem;
    const RayMesh &mesh = problem.mesh();
    const Clock &clock = problem.physics().clock;
    const double end = clock.clock(setting.scene.end_time);
    Approach state = approach_of(problem, last.u, last.front_rate);
    bool too_long = false;
    double step = std::min(1e-3 * (end - last.clock), approach * state.remaining);
    const auto after_step = [&](const AcceptedStep &accepted)
    {
      // The wall may pass the melting temperature when the phase at it vanishes, not
      // before.
      too_long = false;
      if(const auto crossing
         = phases.wall_crossing(problem, last.clock, accepted.clock, accepted.u))
      {
        too_long = crossing->inner == state.to_inner
                   && accepted.size > shortest * (end - clock.clock(segment.time));
        if(too_long)
          return false;
        phases.refuse(problem, crossing->inner, clock.time(crossing->clock));
      }
      accept(segment, accepted);
      last = {accepted.clock, accepted.u, accepted.rate[mesh.front_node(0)]};
      state = approach_of(problem, last.u, last.front_rate);
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
      if(state.distance
         < thinnest_share(mesh, state.to_inner) * (mesh.outer - mesh.inner))
        return remaining_stretch(setting, segment, clock.time(last.clock), last.u,
                                 state.to_inner);
      step = std::min({approach * state.remaining, 2 * step, range->step});
    }
    if(last.clock < end)
      throw cases::NumericalError(options.method, steps, clock.time(last.clock),
                                  "the front",
                                  "comes close to an end of the domain and "
                                  "stays there");
    return std::nullopt;
  }
} // namespace meltfront::reference_fem::fitted
