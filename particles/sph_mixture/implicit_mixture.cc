#include <particles/sph_mixture/implicit_mixture.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  ImplicitMixture::ImplicitMixture(MixtureFlow &flows, const AlloySubstance &substance,
                                   std::size_t particles, double particle_mass)
    : flows(flows)
    , substance(substance)
    , n(particles)
    , mass(particle_mass)
    , view()
    , solver(*this)
  {
  }

  bool ImplicitMixture::take_step(MixtureView composed, std::span<double> concentrations,
                                  double begin, double end, TimeScheme scheme,
                                  WallHeat &heat)
  {
    view = composed;
    const double duration = end - begin;
    const bool trapezoidal = scheme == TimeScheme::crank_nicolson;
    flows.prepare_step(begin, end);
    if(trapezoidal)
      diffuse(concentrations, 0.5 * duration, true);
    const std::span<double> enthalpy(view.enthalpy.data(), padded_size());
    const bool solved = solver.take_step(
        enthalpy, duration, trapezoidal, mass,
        [this](std::span<double> dirichlet) {
          return flows.hold_walls(1, {dirichlet.first(n), view.composition});
        },
        heat);
    if(solved)
      diffuse(concentrations, trapezoidal ? 0.5 * duration : duration, trapezoidal);
    return solved;
  }

  void ImplicitMixture::diffuse(std::span<double> concentrations, double duration,
                                bool second_order)
  {
    if(concentrations.empty())
      return;
    solute_flow.resize(concentrations.size());
    const double most = duration / flows.largest_solute_step(mass);
    const long steps = std::max(1L, std::lround(std::ceil(most * (1 - 1e-12))));
    const double step = duration / steps;
    for(long i = 0; i < steps; ++i)
    {
      if(second_order)
        solute_start.assign(concentrations.begin(), concentrations.end());
      add_flows(concentrations, step);
      if(!second_order)
        continue;
      add_flows(concentrations, step);
      for(std::size_t j = 0; j < concentrations.size(); ++j)
        concentrations[j] = 0.5 * (solute_start[j] + concentrations[j]);
    }
  }

  void ImplicitMixture::add_flows(std::span<double> concentrations, double duration)
  {
    flows.follow(view);
    const std::size_t length = padded_size();
    for(std::size_t s = 0; s < substance.n_solutes(); ++s)
      flows.solute(s, std::span(solute_flow).subspan(s * length, length));
    for(std::size_t j = 0; j < concentrations.size(); ++j)
      concentrations[j] += duration / mass * solute_flow[j];
  }

  // The solver changes the run's own enthalpies, which the view shows.
  double ImplicitMixture::evaluate(std::span<const double>, double fraction,
                                   std::span<double> flow)
  {
    flows.follow_heat(view);
    return flows.heat(fraction, flow);
  }

  void ImplicitMixture::linearise(std::span<const double>, double fraction)
  {
    flows.linearise(fraction, view);
  }

  void ImplicitMixture::apply_derivative(std::span<const double> change,
                                         std::span<double> flow_change)
  {
    flows.apply_derivative(change, flow_change);
  }

  std::span<const double> ImplicitMixture::derivative_diagonal() const
  {
    return flows.derivative_diagonal();
  }

  void ImplicitMixture::correct(std::span<const double> correction,
                                std::span<double> enthalpy) const
  {
    flows.correct(correction, enthalpy);
  }

  double ImplicitMixture::largest_sensible_heat(std::span<const double>) const
  {
    double largest = 0;
    for(const double excess : flows.temperature_excess())
      largest = std::max(largest, std::abs(excess));
    const cases::Material &m = substance.material;
    return std::max(
        1e-3 * m.latent_heat,
        largest
            * std::max(m.solid.specific_heat_capacity, m.liquid.specific_heat_capacity));
  }
} // namespace meltfront::particles
