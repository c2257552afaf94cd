#include <particles/alloy/wall_variable.h>
#include <particles/sph/conduction_spectrum.h>
#include <particles/sph/effective_conductivity.h>
#include <particles/sph_mixture/mixture_flow.h>

#include <fmt/format.h>

namespace meltfront::particles
{
  using cases::Effect;

  namespace
  {
    /** Particles below which handing out a pass to threads costs more than it gains. */
    constexpr std::size_t worth_sharing = 8192;

    constexpr Effect equilibrium_effects[]
        = {Effect::phase_change, Effect::phase_heat_capacity, Effect::phase_conductivity,
           Effect::solute, Effect::eutectic};

    std::string words(ConductionForm form)
    {
      switch(form)
      {
      case ConductionForm::uniform:
        return "that of both phases";
      case ConductionForm::transformed:
      case ConductionForm::integral:
        return "mean over the temperatures between";
      case ConductionForm::arithmetic:
        return "arithmetic mean";
      default:
        return "harmonic mean";
      }
    }
  } // namespace

  MixtureFlow::MixtureFlow(const Discretisation &dis, const AlloySubstance &substance,
                           const cases::EffectSet &effects,
                           const MixtureParameters &parameters, bool uniform)
    : effects(effects)
    , substance(substance)
    , thread_count(dis.particles.size() < worth_sharing ? 1 : parameters.sph.threads)
    , rows(dis, parameters.sph.moment_correction)
    , conduction(substance, parameters.mean, uniform && !substance.diffuses(),
                 dis.particles.size(), rows.rows.padded_rows())
    , wall_excess(excess_variable(substance.material))
  {
    require_true_conductivity(dis, rows.rows);
    if(effects.contains(Effect::solute_diffusion) && substance.diffuses())
      diffusion.emplace(dis, parameters.sph, substance, rows.rows);
    if(effects.contains(Effect::heat_sources))
      heat_sources.emplace(dis);
    if(effects.contains(Effect::wall_temperature))
      wall_temperature.emplace(dis, rows, wall_excess);
    if(effects.contains(Effect::wall_flux))
      wall_flux.emplace(dis, rows);
    if(effects.contains(Effect::robin_wall) || effects.contains(Effect::radiating_wall))
      wall_exchange.emplace(dis, rows);
  }

  void MixtureFlow::prepare_step(double begin, double end)
  {
    if(heat_sources)
      heat_sources->prepare_step(begin, end);
    if(wall_temperature)
      wall_temperature->prepare_step(begin, end);
    if(wall_flux)
      wall_flux->prepare_step(begin, end);
    if(wall_exchange)
      wall_exchange->prepare_step(begin, end);
  }

  double MixtureFlow::hold_walls(double fraction, MixtureView state)
  {
    if(!wall_temperature)
      return 0;
    const auto content = [&state](std::size_t solute, std::size_t row)
    { return solute < state.composition.size() ? state.composition[solute][row] : 0.; };
    return wall_temperature->hold(fraction, state.enthalpy,
                                  [&](std::uint32_t row, double temperature) {
                                    return substance.diagram.enthalpy(
                                        temperature, content(0, row), content(1, row));
                                  });
  }

  Extremes MixtureFlow::follow(MixtureView state)
  {
    const Extremes extremes = follow_heat(state);
    if(diffusion)
      diffusion->follow(conduction.liquid_fraction(), conduction.depressions(),
                        state.composition);
    return extremes;
  }

  Extremes MixtureFlow::follow_heat(MixtureView state)
  {
    return equilibrium_meter.measure(
        [&]
        { return conduction.follow(state.enthalpy, state.composition, thread_count); });
  }

  double MixtureFlow::heat(double fraction, std::span<double> flow)
  {
    conduction.conduct(rows.rows, flow, thread_count);
    return add_outer_heat(fraction, flow);
  }

  double MixtureFlow::evaluate(double fraction, std::span<double> flows)
  {
    const std::size_t size = padded_size();
    const std::span<double> heat_flow = flows.first(size);
    if(!diffusion)
      return heat(fraction, heat_flow);
    const std::size_t first = diffusion->first_to_diffuse();
    const std::span<double> solute_flow = flows.subspan((first + 1) * size, size);
    conduction.with_pair(
        [&](const auto &pair)
        {
          diffusion->flow_with_heat(pair, heat_flow, first, rows.rows, solute_flow,
                                    thread_count);
        });
    rows.take_per_cell(solute_flow);
    for(std::size_t s = 0; s < substance.n_solutes(); ++s)
      if(s != first)
        solute(s, flows.subspan((s + 1) * size, size));
    return add_outer_heat(fraction, heat_flow);
  }

  double MixtureFlow::add_outer_heat(double fraction, std::span<double> flow)
  {
    ++evaluations;
    if(heat_sources)
      heat_sources->add(flow, 1.);
    double through_walls = 0;
    if(wall_flux)
      through_walls += wall_flux->add(fraction, flow, 1.);
    if(wall_exchange)
      through_walls += wall_exchange->add(
          [this](std::size_t row, const cases::Boundary &wall, double ambient,
                 double depth)
          { return conduction.from_surroundings(row, wall, ambient, depth).flux; },
          fraction, flow, 1.);
    if(wall_temperature)
      through_walls += wall_temperature->add([this](std::size_t row, double wall)
                                             { return conduction.from_wall(row, wall); },
                                             fraction, flow);
    rows.take_per_cell(flow);
    return through_walls;
  }

  void MixtureFlow::solute(std::size_t solute, std::span<double> flow)
  {
    diffusion->flow(solute, rows.rows, flow, thread_count);
    rows.take_per_cell(flow);
  }

  double MixtureFlow::monotone_step(double particle_mass) const
  {
    const double heat_rate = rows.largest_row_sum * substance.largest_conductivity()
                             / substance.least_heat_capacity();
    return particle_mass / (heat_rate + (diffusion ? diffusion->row_sum() : 0.));
  }

  StepLimits MixtureFlow::step_limits(const cases::Scene &scene, double particle_mass,
                                      StepLimit asked,
                                      std::span<const std::uint32_t> held) const
  {
    StepLimits limits{monotone_step(particle_mass)};
    if(asked == StepLimit::monotone)
      return limits;
    limits.stable = stable_step(scene, particle_mass, largest_eigenvalue(rows, held));
    if(diffusion)
      limits.stable = std::min(limits.stable, largest_solute_step(particle_mass));
    return limits;
  }

  double MixtureFlow::source_heat(double time) const
  {
    return heat_sources ? heat_sources->heat(time) : 0.;
  }

  std::vector<cases::Parameter> MixtureFlow::describe() const
  {
    return {
        {"interactions per particle",
         fmt::format("{:.4g}", double(rows.rows.interactions()) / rows.rows.rows()), "1"},
        {"second moment divided out", fmt::format("{:.10g}", rows.second_moment), "1"},
        {"conductivity between particles", words(conduction.form()), ""}};
  }

  long MixtureFlow::work() const
  {
    std::size_t per_evaluation = rows.rows.interactions();
    if(wall_temperature)
      per_evaluation += wall_temperature->size();
    if(wall_flux)
      per_evaluation += wall_flux->size();
    if(wall_exchange)
      per_evaluation += wall_exchange->size();
    return evaluations * static_cast<long>(per_evaluation)
           + (diffusion ? diffusion->work() : 0);
  }

  std::vector<cases::EffectCost> MixtureFlow::effect_costs(std::size_t per_solute) const
  {
    // One pass serves these effects: none can be timed alone.
    std::vector<cases::EffectCost> costs;
    for(const Effect effect : equilibrium_effects)
      if(effects.contains(effect))
        costs.push_back(equilibrium_meter.cost(effect, conduction.bytes()));
    for(cases::EffectCost &cost : costs)
    {
      cost.bytes /= static_cast<long>(costs.size());
      cost.seconds /= static_cast<double>(costs.size());
      if(cost.effect == Effect::solute)
        cost.bytes += static_cast<long>(per_solute * substance.n_solutes());
    }
    if(diffusion)
      costs.push_back(diffusion->cost(0));
    if(heat_sources)
      costs.push_back(heat_sources->cost());
    if(wall_temperature)
      costs.push_back(wall_temperature->cost());
    if(wall_flux)
      costs.push_back(wall_flux->cost());
    for(const Effect effect : {Effect::robin_wall, Effect::radiating_wall})
      if(effects.contains(effect))
        costs.push_back(wall_exchange->cost(effect));
    return costs;
  }
} // namespace meltfront::particles
