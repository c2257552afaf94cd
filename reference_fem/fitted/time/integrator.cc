#include <reference_fem/fitted/time/integrator_implementation.h>

#include <cases/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    unsigned int bdf_order(const Scheme scheme)
    {
      switch(scheme)
      {
      case Scheme::bdf2:
        return 2;
      case Scheme::bdf3:
        return 3;
      case Scheme::bdf4:
        return 4;
      default:
        return 0;
      }
    }
  } // namespace

  Scheme scheme_of(const std::string &name)
  {
    if(name == "bdf2")
      return Scheme::bdf2;
    if(name == "bdf3")
      return Scheme::bdf3;
    if(name == "bdf4")
      return Scheme::bdf4;
    if(name == "radau3")
      return Scheme::radau3;
    if(name == "radau5")
      return Scheme::radau5;
    throw cases::InputError("unknown time scheme '" + name
                            + "'; the schemes are bdf2, bdf3, bdf4, radau3 and radau5");
  }

  Integrator::Implementation::Implementation(const ConservationProblem &problem,
                                             IntegrationOptions given)
    : problem(problem)
    , options(std::move(given))
    , radau(options.scheme == Scheme::radau3 ? 2 : 3)
    , order(bdf_order(options.scheme))
    , newton(problem, options, cost)
    , pattern(problem.sparsity())
    , linearisation(problem)
  {
    if(options.tolerance > 0 && order > 0)
      throw cases::InputError("step control needs a one-step scheme: radau3 or radau5");
  }

  void Integrator::Implementation::start(const double new_clock, const Vector &new_u)
  {
    clock = new_clock;
    u = new_u;
    const std::string reason_invalid = problem.reason_invalid(u);
    if(!reason_invalid.empty())
      fail("cannot start from this state: " + reason_invalid);
    mass = mass_of(u, clock);
    scale = problem.scale(u);
    history.clear();
    past_clocks.clear();
    past_states.clear();
    if(order > 0)
      remember();
  }

  bool Integrator::Implementation::advance_to(const double end, const double step,
                                              const AfterStep &after_step)
  {
    if(!(end >= clock) || !(step > 0))
      throw cases::InputError(
          "time integration needs an end after its start and a positive step");
    if(end == clock)
      return true;
    stopped = false;
    if(options.tolerance > 0)
    {
      proposal = step;
      return integrate_interval(end, after_step);
    }
    // Rounding in (end - clock) / step must not cost a step more.
    const double begin = clock;
    const long n_steps
        = std::max(1L, static_cast<long>(std::ceil((end - begin) / step - 1e-6)));
    const double size = (end - begin) / n_steps;
    if(order > 0
       && (std::abs(size - history_step) > 1e-9 * size || history.front().clock != clock))
    {
      history.clear();
      remember();
    }
    history_step = size;
    for(long k = 1; k <= n_steps && !stopped; ++k)
    {
      proposal = size;
      const bool reached
          = integrate_interval(k == n_steps ? end : begin + k * size, after_step);
      if(order > 0 && reached)
        remember();
    }
    return clock == end;
  }

  bool Integrator::Implementation::integrate_interval(const double end,
                                                      const AfterStep &after_step)
  {
    while(clock < end && !stopped)
      if(options.tolerance > 0)
        controlled_step(end, after_step);
      else
        accept(step_towards(end), after_step);
    return clock == end;
  }

  void Integrator::Implementation::accept(Outcome outcome, const AfterStep &after_step)
  {
    if(outcome.stages.size() > 1)
    {
      past_clocks.assign(1, clock);
      for(const double node : radau.nodes)
        past_clocks.push_back(clock + node * outcome.size);
      past_states.assign(1, u);
      past_states.insert(past_states.end(), outcome.stages.begin(), outcome.stages.end());
    }
    else
      past_states.clear();
    clock = outcome.end;
    u = std::move(outcome.stages.back());
    mass = mass_of(u, clock);
    scale = problem.scale(u);
    ++cost.steps;
    cost.most_iterations
        = std::max(cost.most_iterations, static_cast<long>(outcome.iterations));
    if(after_step)
      stopped = !after_step(
          {cost.steps, clock, outcome.size, outcome.iterations, u, outcome.rates.back()});
  }

  void Integrator::Implementation::remember()
  {
    history.push_front({clock, u, mass});
    // One state more than the formula needs serves the prediction.
    while(history.size() > order + 1)
      history.pop_back();
  }

  dealii::Vector<double> Integrator::Implementation::mass_of(const Vector &state,
                                                             const double at) const
  {
    Vector rate(state.size()), result(state.size()), flow(state.size());
    problem.evaluate(at, state, rate, result, flow);
    return result;
  }

  void Integrator::Implementation::fail(const std::string &reason) const
  {
    throw cases::NumericalError(options.method, cost.steps + 1, options.time(clock),
                                "the time integration", reason);
  }

  Integrator::Integrator(const ConservationProblem &problem, IntegrationOptions options)
    : implementation(std::make_unique<Implementation>(problem, std::move(options)))
  {
  }

  Integrator::~Integrator() = default;

  void Integrator::start(const double clock, const dealii::Vector<double> &u)
  {
    implementation->start(clock, u);
  }

  bool Integrator::advance_to(const double end, const double step,
                              const AfterStep &after_step)
  {
    return implementation->advance_to(end, step, after_step);
  }

  double Integrator::clock() const
  {
    return implementation->clock;
  }

  const dealii::Vector<double> &Integrator::state() const
  {
    return implementation->u;
  }

  double Integrator::proposed_step() const
  {
    return implementation->proposal;
  }

  const IntegrationCost &Integrator::cost() const
  {
    return implementation->cost;
  }
} // namespace meltfront::reference_fem::fitted
