#include <reference_fem/fitted/time/coefficients.h>
#include <reference_fem/fitted/time/integrator.h>
#include <reference_fem/fitted/time/stage_newton.h>

#include <cases/error.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using Vector = dealii::Vector<double>;

    /** The past is not extrapolated farther than so many times its length. */
    constexpr double farthest_prediction = 20;

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

  class Integrator::Implementation
  {
  public:
    Implementation(const ConservationProblem &problem, IntegrationOptions given)
      : problem(problem)
      , options(std::move(given))
      , radau(options.scheme == Scheme::radau3 ? 2 : 3)
      , order(bdf_order(options.scheme))
      , newton(problem, options, cost)
      , pattern(problem.sparsity())
      , linearization(problem)
    {
      if(options.tolerance > 0 && order > 0)
        throw cases::InputError("step control needs a one-step scheme: radau3 or radau5");
    }

    void start(double new_clock, const Vector &new_u);
    bool advance_to(double end, double step, const AfterStep &after_step);

    double clock = 0;
    Vector u;
    double proposal = 0;
    IntegrationCost cost;

  private:
    /** A state and its masses at the end of a step of BDF. */
    struct Past
    {
      double clock;
      Vector u, mass;
    };

    /** What a step led to, before it is accepted. */
    struct Outcome
    {
      double size = 0, end = 0;
      unsigned int iterations = 0;
      Stages stages, rates, flows;
    };

    /** Try a step; without a value where it failed, and `failure` says why. */
    std::optional<Outcome> try_bdf(double end);
    std::optional<Outcome> try_radau(double end);
    std::optional<Outcome> solve(StageEquations &equations, Stages stages, double end);

    /** One step to the given clock or to an earlier one, as far as it succeeds. */
    Outcome step_towards(double end);

    /** The extrapolation of the past to a clock; the present state where the problem
     * objects to it. */
    Vector predict(const std::vector<double> &clocks,
                   const std::vector<const Vector *> &states, double at) const;

    /** Of the state at the end of a Radau step, in units of scale(). */
    double estimated_error(const Outcome &outcome);

    bool integrate_interval(double end, const AfterStep &after_step);
    void controlled_step(double end, const AfterStep &after_step);
    void accept(Outcome outcome, const AfterStep &after_step);

    /** Add the present state to what BDF steps build on. */
    void remember();

    Vector mass_of(const Vector &state, double at) const;
    [[noreturn]] void fail(const std::string &reason) const;

    const ConservationProblem &problem;
    IntegrationOptions options;
    RadauCoefficients radau;
    unsigned int order; ///< of BDF, 0 for Radau
    StageNewton newton;
    SortedPattern pattern;
    Linearization linearization;
    CompressedRows<double> estimate_matrix;
    Factorization<double> estimate_factors;

    Vector mass, scale;
    std::deque<Past> history;        ///< for BDF, the latest first
    double history_step = 0;         ///< between its states
    std::vector<double> past_clocks; ///< of the last Radau step: start and stages
    Stages past_states;
    std::string failure;
    bool stopped = false;
  };

  void Integrator::Implementation::start(const double new_clock, const Vector &new_u)
  {
    clock = new_clock;
    u = new_u;
    const std::string objection = problem.objection(u);
    if(!objection.empty())
      fail("cannot start from this state: " + objection);
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

  void Integrator::Implementation::controlled_step(const double end,
                                                   const AfterStep &after_step)
  {
    const double left = end - clock;
    if(proposal < 1e-14 * std::max(std::abs(clock), std::abs(end)))
      fail("asks for steps below rounding: the tolerance cannot be met");
    const bool whole = 1.01 * proposal >= left;
    const double step = whole ? left : std::min(proposal, left / 2);
    Outcome outcome = step_towards(whole ? end : clock + step);
    const double error = estimated_error(outcome) / options.tolerance;
    const double exponent = 1. / (static_cast<double>(radau.nodes.size()) + 1);
    const double factor
        = std::clamp(0.9 * std::pow(std::max(error, 1e-12), -exponent), 0.2, 4.);
    if(!(error <= 1))
    {
      ++cost.repeated;
      proposal = outcome.size * std::min(factor, 0.9);
      return;
    }
    // A step that the end cut short says nothing against the longer one.
    const bool cut = outcome.size < proposal && outcome.end == clock + step;
    proposal
        = outcome.size * factor > proposal || !cut ? outcome.size * factor : proposal;
    accept(std::move(outcome), after_step);
  }

  Integrator::Implementation::Outcome Integrator::Implementation::step_towards(double end)
  {
    if(order > 0 && history.size() >= order && history.front().clock == clock)
    {
      if(auto outcome = try_bdf(end))
        return *std::move(outcome);
      ++cost.fallbacks;
    }
    else if(order > 0)
      ++cost.starts;
    for(unsigned int halving = 0; halving <= options.halving_limit; ++halving)
    {
      if(auto outcome = try_radau(end))
        return *std::move(outcome);
      ++cost.halved;
      end = clock + (end - clock) / 2;
    }
    fail(failure + " (after " + std::to_string(options.halving_limit)
         + " halvings of the step)");
  }

  std::optional<Integrator::Implementation::Outcome>
  Integrator::Implementation::try_bdf(const double end)
  {
    const std::vector<double> alpha = bdf_coefficients(order);
    Vector past_mass(u.size()), past_u(u.size());
    for(unsigned int k = 1; k <= order; ++k)
    {
      past_mass.add(alpha[k], history[k - 1].mass);
      past_u.add(alpha[k], history[k - 1].u);
    }
    std::vector<double> clocks;
    std::vector<const Vector *> states;
    for(const Past &past : history)
    {
      clocks.push_back(past.clock);
      states.push_back(&past.u);
    }
    StageEquations equations(problem, dealii::FullMatrix<double>(1, 1, alpha.data()),
                             {end}, end - clock, {past_mass}, {past_u});
    return solve(equations, {predict(clocks, states, end)}, end);
  }

  std::optional<Integrator::Implementation::Outcome>
  Integrator::Implementation::try_radau(const double end)
  {
    const unsigned int s = static_cast<unsigned int>(radau.nodes.size());
    const double step = end - clock;
    std::vector<const Vector *> states;
    for(const Vector &state : past_states)
      states.push_back(&state);
    std::vector<double> clocks(s);
    Stages mass_offset(s, mass), rate_offset(s, u), stages(s, u);
    for(unsigned int j = 0; j < s; ++j)
    {
      clocks[j] = j + 1 == s ? end : clock + radau.nodes[j] * step;
      double sum = 0;
      for(unsigned int k = 0; k < s; ++k)
        sum += radau.inverse(j, k);
      mass_offset[j] *= -sum;
      rate_offset[j] *= -sum;
      if(!states.empty())
        stages[j] = predict(past_clocks, states, clocks[j]);
    }
    StageEquations equations(problem, radau.inverse, clocks, step, std::move(mass_offset),
                             std::move(rate_offset));
    return solve(equations, std::move(stages), end);
  }

  std::optional<Integrator::Implementation::Outcome>
  Integrator::Implementation::solve(StageEquations &equations, Stages stages,
                                    const double end)
  {
    const StageNewton::Result result = newton.solve(equations, scale, stages);
    if(!result.problem.empty())
    {
      failure = result.problem;
      return std::nullopt;
    }
    Outcome outcome;
    outcome.size = end - clock;
    outcome.end = end;
    outcome.iterations = result.iterations;
    for(unsigned int j = 0; j < equations.n_stages(); ++j)
    {
      outcome.rates.push_back(equations.rate(j, stages));
      outcome.flows.push_back(equations.flow()[j]);
    }
    outcome.stages = std::move(stages);
    return outcome;
  }

  Vector Integrator::Implementation::predict(const std::vector<double> &clocks,
                                             const std::vector<const Vector *> &states,
                                             const double at) const
  {
    const auto [first, last] = std::minmax_element(clocks.begin(), clocks.end());
    if(at - *last > farthest_prediction * (*last - *first))
      return u;
    const std::vector<double> weights = lagrange_weights(clocks, at);
    Vector prediction(u.size());
    for(std::size_t k = 0; k < states.size(); ++k)
      prediction.add(weights[k], *states[k]);
    return problem.objection(prediction).empty() ? prediction : u;
  }

  double Integrator::Implementation::estimated_error(const Outcome &outcome)
  {
    // Radau's stages and the start of the step with the weight gamma_0 make an embedded
    // formula of order s: it differs by h gamma_0 times F less the extrapolation of F
    // from the stages, filtered by the Jacobian because the problem is stiff.
    const std::vector<double> weights = lagrange_weights(radau.nodes, 0);
    Vector rate(u.size()), at_start(u.size()), flow(u.size());
    for(std::size_t j = 0; j < weights.size(); ++j)
      rate.add(weights[j], outcome.rates[j]);
    problem.evaluate(clock, u, rate, at_start, flow);
    for(std::size_t j = 0; j < weights.size(); ++j)
      flow.add(-weights[j], outcome.flows[j]);

    linearization.mass_jacobian = 0.;
    linearization.flow_jacobian = 0.;
    linearization.rate_jacobian = 0.;
    problem.linearize(outcome.end, outcome.stages.back(), outcome.rates.back(),
                      linearization.mass, linearization.flow, linearization.mass_jacobian,
                      linearization.flow_jacobian, linearization.rate_jacobian);
    assemble_shifted(pattern, linearization, 1 / radau.estimate_weight, outcome.size,
                     estimate_matrix);
    ++cost.factorizations;
    if(!estimate_factors.factorize(estimate_matrix))
      fail("has a singular Jacobian in the estimate of the step's error");
    cost.work += static_cast<long>(estimate_matrix.values.size())
                 + 2 * estimate_factors.n_entries();
    std::vector<double> difference;
    estimate_factors.solve({flow.begin(), flow.end()}, difference);
    double largest = 0;
    for(unsigned int i = 0; i < u.size(); ++i)
      largest = std::max(largest, std::abs(difference[i]) / scale[i]);
    return largest;
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

  Vector Integrator::Implementation::mass_of(const Vector &state, const double at) const
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
