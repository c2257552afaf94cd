#include <reference_fem/fitted/events/timeline.h>

#include <cases/error.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using dealii::Vector;

    /** The share of a ray at which a phase is dropped. */
    constexpr double thinnest = 1e-9;

    /** A front is approached that will reach an end within so many steps. */
    constexpr double steps_ahead = 2;

    /** The share of the time left to the end of the ray that a step of the approach
     * takes. */
    constexpr double approach = 0.8;

    /** More steps of an approach mean that the front never arrives. */
    constexpr int longest_approach = 1000;

    /** The wall's temperature may differ from the melting temperature by rounding. */
    constexpr double rounding = 1e-12;

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
      return result;
    }

    void add(const IntegrationCost &cost, IntegrationCost &total)
    {
      total.rejected += cost.rejected;
      total.iterations += cost.iterations;
      total.most_iterations = std::max(total.most_iterations, cost.most_iterations);
      total.factorizations += cost.factorizations;
      total.work += cost.work;
    }
  } // namespace

  Timeline::Timeline(EventScene setting, IntegrationOptions options, Listener listener)
    : setting(std::move(setting))
    , options(std::move(options))
    , listener(std::move(listener))
  {
  }

  void Timeline::run(Stretch first)
  {
    const HeatContent heat = first.problem->heat(first.time, first.state);
    initial_heat = heat.sensible + heat.latent;
    std::optional<Stretch> stretch = std::move(first);
    begin(*stretch);
    listener.step(0, stretch->time, stretch->state, false);
    if(!stretch->problem->mesh().has_front())
      if(const auto start = sudden_start(setting))
      {
        stretch = seeded_stretch(setting, *start, initial_heat);
        begin(*stretch);
      }
    while((stretch = integrate(*stretch)))
      begin(*stretch);
    total.steps = steps;
  }

  void Timeline::begin(const Stretch &stretch)
  {
    if(!stretch.event.text.empty())
      happened.push_back(stretch.event);
    listener.begin(stretch);
  }

  IntegrationOptions Timeline::options_for(const Stretch &stretch) const
  {
    IntegrationOptions result = options;
    result.time = [clock = stretch.problem->physics().clock](const double value)
    { return clock.time(value); };
    return result;
  }

  bool Timeline::crossed(const Stretch &stretch, const Vector<double> &u,
                         const bool inner) const
  {
    const FittedProblem &problem = *stretch.problem;
    if(inner && problem.mesh().has_centre())
      return false;
    const double excess = wall_excess(problem, u, inner);
    const double slack = rounding * problem.physics().temperature_scale;
    return problem.physics().phases[0].solid ? excess > slack : excess < -slack;
  }

  void Timeline::accept(const Stretch &stretch, const AcceptedStep &step)
  {
    const Clock &clock = stretch.problem->physics().clock;
    const double end = setting.scene.end_time;
    const bool last = step.clock == clock.clock(end);
    listener.step(++steps, last ? end : clock.time(step.clock), step.u, last);
  }

  std::optional<Stretch> Timeline::integrate(const Stretch &stretch)
  {
    const FittedProblem &problem = *stretch.problem;
    const Clock &clock = problem.physics().clock;
    const bool has_front = problem.mesh().has_front();
    Integrator integrator(problem, options_for(stretch));
    integrator.start(clock.clock(stretch.time), stretch.state);
    double before = integrator.clock();
    Vector<double> u = stretch.state;
    std::optional<bool> crossing;
    bool arrives = false;
    const auto after_step = [&](const AcceptedStep &step)
    {
      if(!has_front)
        for(const bool inner : {true, false})
          if(crossed(stretch, step.u, inner))
          {
            crossing = inner;
            return false;
          }
      accept(stretch, step);
      before = step.clock;
      u = step.u;
      // In more dimensions no event is followed: a front that reaches an end has turned
      // an element over.
      if(has_front && setting.options.dimension == 1)
        arrives
            = approach_of(problem, u, step.rate[problem.mesh().front_node(0)]).remaining
              < steps_ahead * step.size;
      return !arrives;
    };
    std::optional<Stretch> next;
    for(const StepRange &range : stretch.steps)
      if(!integrator.advance_to(range.end, range.step * (1 + 1e-9), after_step))
        break;
    if(crossing)
      next = cross_wall(stretch, integrator, before, u, integrator.clock(), *crossing);
    else if(arrives && integrator.clock() < clock.clock(setting.scene.end_time))
      next = approach_end(stretch, integrator);
    add(integrator.cost(), total);
    return next;
  }

  std::optional<Stretch> Timeline::cross_wall(const Stretch &stretch,
                                              Integrator &integrator, const double before,
                                              const Vector<double> &u, const double after,
                                              const bool inner)
  {
    const FittedProblem &problem = *stretch.problem;
    if(!(before > problem.physics().clock.clock(stretch.time)))
      throw cases::Refusal("fem-fitted cannot start a front at a wall that is at the "
                           "melting temperature already and loses heat, or that passes "
                           "it within one step; shorter steps would help in the latter "
                           "case");
    const auto excess_at = [&](const double end)
    {
      integrator.start(before, u);
      integrator.advance_to(end, after - before);
      return wall_excess(problem, integrator.state(), inner);
    };
    const double at_start = wall_excess(problem, u, inner), at_end = excess_at(after);
    double crossing = before;
    // A step may end on the melting temperature, up to rounding.
    if(at_start * at_end < 0)
    {
      std::uintmax_t iterations = 60;
      const auto bracket = boost::math::tools::toms748_solve(
          [&](const double end) { return end == before ? at_start : excess_at(end); },
          before, after, at_start, at_end, boost::math::tools::eps_tolerance<double>(50),
          iterations);
      crossing = 0.5 * (bracket.first + bracket.second);
      excess_at(crossing);
    }
    else
      integrator.start(before, u);
    return late_stretch(setting, stretch, problem.physics().clock.time(crossing),
                        integrator.state(), inner, options_for(stretch));
  }

  std::optional<Stretch> Timeline::approach_end(const Stretch &stretch,
                                                Integrator &integrator)
  {
    const FittedProblem &problem = *stretch.problem;
    const RayMesh &mesh = problem.mesh();
    const Clock &clock = problem.physics().clock;
    const double end = clock.clock(setting.scene.end_time);
    Approach state;
    double step = 0;
    const auto after_step = [&](const AcceptedStep &accepted)
    {
      accept(stretch, accepted);
      state = approach_of(problem, accepted.u, accepted.rate[mesh.front_node(0)]);
      step = accepted.size;
      return false;
    };
    // The rate is known after a step only: the first is as short as it can be.
    step = 1e-3 * (end - integrator.clock());
    for(int k = 0; k < longest_approach && integrator.clock() < end; ++k)
    {
      integrator.advance_to(std::min(end, integrator.clock() + step), step, after_step);
      if(state.distance < thinnest * (mesh.outer - mesh.inner))
        return remaining_stretch(setting, stretch, clock.time(integrator.clock()),
                                 integrator.state(), state.to_inner);
      step = std::min({approach * state.remaining, 2 * step, stretch.steps.back().step});
    }
    if(integrator.clock() < end)
      throw cases::NumericalError(options.method, steps, clock.time(integrator.clock()),
                                  "the front",
                                  "comes close to an end of the domain and "
                                  "stays there");
    return std::nullopt;
  }
} // namespace meltfront::reference_fem::fitted
