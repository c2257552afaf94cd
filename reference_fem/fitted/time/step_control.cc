#include <reference_fem/fitted/time/integrator_implementation.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::reference_fem::fitted
{
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

    linearisation.mass_jacobian = 0.;
    linearisation.flow_jacobian = 0.;
    linearisation.rate_jacobian = 0.;
    problem.linearise(outcome.end, outcome.stages.back(), outcome.rates.back(),
                      linearisation.mass, linearisation.flow, linearisation.mass_jacobian,
                      linearisation.flow_jacobian, linearisation.rate_jacobian);
    assemble_shifted(pattern, linearisation, 1 / radau.estimate_weight, outcome.size,
                     estimate_matrix);
    ++cost.factorisations;
    if(!estimate_factors.factorise(estimate_matrix))
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
} // namespace meltfront::reference_fem::fitted
