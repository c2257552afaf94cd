#include <reference_fem/fitted/time/integrator_implementation.h>

#include <algorithm>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    /** The past is not extrapolated farther than so many times its length. */
    constexpr double farthest_prediction = 20;
  } // namespace

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

  dealii::Vector<double>
  Integrator::Implementation::predict(const std::vector<double> &clocks,
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
    return problem.reason_invalid(prediction).empty() ? prediction : u;
  }
} // namespace meltfront::reference_fem::fitted
