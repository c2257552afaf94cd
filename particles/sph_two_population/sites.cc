#include <cases/compensated_sum.h>
#include <cases/error.h>
#include <particles/sph_two_population/sites.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace meltfront::particles
{
  Sites::Sites(const Discretisation &dis, const AlloySubstance &substance,
               const TwoPopulationParameters &parameters, const MixtureState &initial,
               std::size_t padded)
    : concentration(initial.concentration)
    , is_dirichlet(dis.particles.size(), 0)
    , is_kept(dis.particles.size(), 0)
    , site_mass(dis.particle_volume * substance.density)
    , crystal_density(substance.density / substance.expansion)
    , substance(substance)
    , parameters(parameters)
    , n(dis.particles.size())
    , volume(dis.particle_volume)
    , exchange(substance, site_mass, parameters.constant_latent_heat,
               parameters.new_ice == NewIce::site && !parameters.constant_latent_heat)
  {
    if(!substance.diagram.straight())
    {
      if(parameters.new_ice == NewIce::kernel || parameters.constant_latent_heat
         || parameters.exchange == PhaseExchange::published)
        throw cases::Refusal(fmt::format(
            "{} takes a curved liquidus only with exchange = corrected, new_ice = site "
            "and latent_heat = energy_function",
            parameters.name));
      curve.emplace(substance);
    }
    for(const cases::Solute &solute : substance.alloy.solutes)
      weight.push_back(curve ? 1. : solute.liquidus_slope);
    check_composition(dis);
    for(Population *p : {&liquid, &ice})
      for(auto *array : {&p->mass, &p->heat, &p->excess, &p->share})
        array->assign(padded, 0.);
    for(auto *array : {&liquid_fraction, &depression})
      array->assign(padded, 0.);
    for(const std::uint32_t a : dis.dirichlet)
      is_dirichlet[a] = 1;
    for(std::size_t a = 0; a < n; ++a)
      share_out(initial, a);
    if(parameters.new_ice == NewIce::kernel
       || parameters.exchange == PhaseExchange::published)
    {
      kernel_sums.emplace(dis);
      for(auto *array : {&solid_volume, &normaliser, &new_ice, &new_heat, &gained})
        array->assign(padded, 0.);
      for(std::size_t a = 0; a < n; ++a)
        new_ice[a] = is_dirichlet[a] ? 0. : 1.;
      kernel_sums->sum(new_ice, normaliser);
      for(std::size_t a = 0; a < n; ++a)
        normaliser[a] = 1 / normaliser[a];
      std::fill(new_ice.begin(), new_ice.end(), 0.);
    }
    update();
  }

  void Sites::check_composition(const Discretisation &dis) const
  {
    for(std::size_t a = 0; a < n; ++a)
    {
      const double x = dis.particles.position[0][a];
      if(!(dissolved(a) > 0))
        throw cases::Refusal(
            fmt::format("{} needs solute everywhere, and there is none at x = {:.6g} m",
                        parameters.name, x));
      if(curve && concentration[0][a] > curve->largest_concentration())
        throw cases::InputError(fmt::format(
            "the initial concentration is {:.6g} at x = {:.6g} m; the liquidus is known "
            "up to {:.6g}",
            concentration[0][a], x, curve->largest_concentration()));
    }
  }

  void Sites::share_out(const MixtureState &initial, std::size_t a)
  {
    const cases::PhaseState state = substance.diagram.equilibrium(
        initial.enthalpy[a], concentration[0][a],
        concentration.size() > 1 ? concentration[1][a] : 0.);
    const cases::Material &m = substance.material;
    const double part = is_dirichlet[a] ? 0. : state.liquid_fraction;
    const double x = state.temperature - m.melting_temperature;
    liquid.mass[a] = part * site_mass;
    ice.mass[a] = is_dirichlet[a] ? crystal_density * volume : site_mass - liquid.mass[a];
    ice.heat[a] = ice.mass[a] * m.solid.specific_heat_capacity * x;
    if(is_dirichlet[a])
    {
      for(auto &solute : concentration)
        solute[a] = 0;
      return;
    }
    // The larger part takes the rest: together they hold the enthalpy given.
    const double whole = site_mass * initial.enthalpy[a];
    if(part > 0.5)
    {
      liquid.heat[a] = whole - ice.heat[a];
      return;
    }
    liquid.heat[a]
        = liquid.mass[a] * (m.liquid.specific_heat_capacity * x + m.latent_heat);
    ice.heat[a] = whole - liquid.heat[a];
  }

  double Sites::dissolved(std::size_t a) const
  {
    double sum = 0;
    for(std::size_t s = 0; s < concentration.size(); ++s)
      sum += weight[s] * concentration[s][a];
    return sum * site_mass;
  }

  std::optional<std::size_t> Sites::beyond_liquidus() const
  {
    if(!curve)
      return std::nullopt;
    const double largest = curve->largest_concentration() * (1 + 1e-12);
    // What has frozen at the eutectic temperature holds solute that its liquid does not.
    const double eutectic = curve->eutectic_concentration();
    const double most_frozen = eutectic <= largest
                                   ? substance.eutectic_excess * (1 - 1e-12)
                                   : -std::numeric_limits<double>::infinity();
    for(std::size_t a = 0; a < n; ++a)
      if(!is_dirichlet[a] && dissolved(a) > largest * liquid.mass[a]
         && liquid.excess[a] > most_frozen)
        return a;
    return std::nullopt;
  }

  void Sites::change_phase()
  {
    meter.measure(
        [this]
        {
          with_liquidus([this](const auto &solute_of) { change_sites(solute_of); });
          if(parameters.new_ice == NewIce::kernel)
            spread_new_ice();
          update();
        });
  }

  template <typename SoluteOf>
  void Sites::change_sites(const SoluteOf &solute_of)
  {
    for(std::size_t a = 0; a < n; ++a)
    {
      if(is_dirichlet[a])
        continue;
      const auto solute = solute_of(dissolved(a));
      SiteContent<double> site = content(a);
      if(parameters.new_ice == NewIce::site)
        is_kept[a] = exchange.settle(site, solute);
      else if(exchange.freezes(site, solute))
      {
        const SiteExchange::NewIce<double> made = exchange.freeze_liquid(site, solute);
        new_ice[a] = made.mass;
        new_heat[a] = made.heat;
      }
      set_content(a, site);
    }
  }

  SiteContent<double> Sites::content(std::size_t a) const
  {
    return {liquid.mass[a], liquid.heat[a], ice.mass[a], ice.heat[a]};
  }

  void Sites::set_content(std::size_t a, const SiteContent<double> &site)
  {
    liquid.mass[a] = site.liquid_mass;
    liquid.heat[a] = site.liquid_heat;
    ice.mass[a] = site.ice_mass;
    ice.heat[a] = site.ice_heat;
  }

  void Sites::spread_new_ice()
  {
    const auto spread = [&](std::vector<double> &made, std::vector<double> &array)
    {
      for(std::size_t a = 0; a < n; ++a)
        made[a] *= normaliser[a];
      kernel_sums->sum(made, gained);
      work += static_cast<long>(kernel_sums->interactions());
      for(std::size_t a = 0; a < n; ++a)
        if(!is_dirichlet[a])
          array[a] += gained[a];
      std::fill(made.begin(), made.end(), 0.);
    };
    spread(new_ice, ice.mass);
    spread(new_heat, ice.heat);
  }

  void Sites::update()
  {
    const cases::Material &m = substance.material;
    const bool summed = parameters.exchange == PhaseExchange::published;
    if(summed)
    {
      kernel_sums->sum(ice.mass, gained); // density of ice, equation 4.18
      work += static_cast<long>(kernel_sums->interactions());
    }
    with_liquidus(
        [this](const auto &solute_of)
        {
          for(std::size_t a = 0; a < n; ++a)
            depression[a] = solute_of(dissolved(a)).depression(site_mass);
        });
    for(std::size_t a = 0; a < n; ++a)
    {
      liquid_fraction[a] = liquid.mass[a] / site_mass;
      const bool any_ice = ice.mass[a] > 0, any_liquid = liquid.mass[a] > 0;
      if(any_liquid)
        liquid.excess[a] = (liquid.heat[a] / liquid.mass[a] - m.latent_heat)
                           / m.liquid.specific_heat_capacity;
      if(any_ice && !is_dirichlet[a])
        ice.excess[a] = ice.heat[a] / (ice.mass[a] * m.solid.specific_heat_capacity);
      if(!any_ice)
        ice.excess[a] = liquid.excess[a];
      if(!any_liquid)
        liquid.excess[a] = ice.excess[a];
      if(summed)
      {
        ice.share[a] = any_ice ? ice.mass[a] / (gained[a] * volume) : 0.;
        // Where ice fills more than all volume a thousandth is left to the liquid.
        solid_volume[a] = std::clamp(gained[a] / crystal_density, 0., 0.999);
        liquid.share[a] = liquid_fraction[a] / (1 - solid_volume[a]);
        continue;
      }
      ice.share[a] = std::min(ice.mass[a] / (crystal_density * volume), 1.);
      liquid.share[a] = std::min(1 - ice.share[a], liquid_fraction[a]);
    }
  }

  void Sites::add_heat(std::span<const double> to_liquid, std::span<const double> to_ice,
                       double duration)
  {
    for(std::size_t a = 0; a < n; ++a)
    {
      liquid.heat[a] += duration * to_liquid[a];
      ice.heat[a] += duration * to_ice[a];
    }
  }

  void Sites::add_solute(std::size_t solute, std::span<const double> flow,
                         double duration)
  {
    const double factor = duration / site_mass;
    for(std::size_t a = 0; a < n; ++a)
      concentration[solute][a] += factor * flow[a];
  }

  void Sites::store(std::vector<double> &state) const
  {
    auto end = state.begin();
    for(const auto *field : {&liquid.mass, &liquid.heat, &ice.mass, &ice.heat})
      end = std::copy(field->begin(), field->end(), end);
    for(const auto &field : concentration)
    {
      std::copy(field.begin(), field.end(), end);
      end += static_cast<std::ptrdiff_t>(liquid.mass.size());
    }
  }

  void Sites::load(std::span<const double> state)
  {
    for(auto *field : {&liquid.mass, &liquid.heat, &ice.mass, &ice.heat})
    {
      std::copy_n(state.begin(), field->size(), field->begin());
      state = state.subspan(field->size());
    }
    for(auto &field : concentration)
    {
      std::copy_n(state.begin(), field.size(), field.begin());
      state = state.subspan(liquid.mass.size());
    }
    change_phase();
  }

  void Sites::make_rates(std::span<double> flows) const
  {
    with_liquidus([&](const auto &solute_of) { make_rates(flows, solute_of); });
  }

  template <typename SoluteOf>
  void Sites::make_rates(std::span<double> flows, const SoluteOf &solute_of) const
  {
    const std::size_t size = liquid.mass.size();
    double *liquid_mass = flows.data(), *liquid_heat = liquid_mass + size;
    double *ice_mass = liquid_heat + size, *ice_heat = ice_mass + size;
    double *solute = ice_heat + size;
    for(std::size_t a = 0; a < n; ++a)
    {
      liquid_mass[a] = ice_mass[a] = 0;
      double solute_flow = 0;
      for(std::size_t s = 0; s < concentration.size(); ++s)
      {
        solute_flow += weight[s] * solute[s * size + a];
        solute[s * size + a] /= site_mass;
      }
      if(is_dirichlet[a] || is_kept[a] || !(ice.mass[a] > 0))
        continue;
      const SiteExchange::NewIce<double> made = exchange.freezing_rate(
          content(a), solute_of(dissolved(a)), liquid_heat[a], solute_flow);
      liquid_mass[a] = -made.mass;
      liquid_heat[a] -= made.heat;
      ice_mass[a] = made.mass;
      ice_heat[a] += made.heat;
    }
  }

  std::vector<cases::EffectCost> Sites::costs(const cases::EffectSet &effects,
                                              std::size_t per_solute) const
  {
    using cases::Effect;
    // One pass serves these effects: none can be timed alone.
    std::vector<cases::EffectCost> result;
    for(const Effect effect :
        {Effect::phase_change, Effect::phase_heat_capacity, Effect::phase_conductivity,
         Effect::solute, Effect::eutectic})
      if(effects.contains(effect))
        result.push_back(meter.cost(effect, 10 * liquid.mass.size() * sizeof(double)));
    for(cases::EffectCost &cost : result)
    {
      cost.bytes /= static_cast<long>(result.size());
      cost.seconds /= static_cast<double>(result.size());
      if(cost.effect == Effect::solute)
        cost.bytes += static_cast<long>(per_solute * substance.n_solutes());
    }
    return result;
  }

  cases::HeatBudget Sites::heat_content(double measure) const
  {
    const double latent_heat = substance.material.latent_heat;
    cases::CompensatedSum stored, latent;
    for(std::size_t a = 0; a < n; ++a)
    {
      if(is_dirichlet[a])
        continue;
      latent.add(latent_heat * liquid.mass[a]);
      stored.add(liquid.heat[a] - latent_heat * liquid.mass[a]);
      stored.add(ice.heat[a]);
    }
    cases::HeatBudget heat;
    heat.stored = stored.value() / measure;
    heat.latent = latent.value() / measure;
    heat.initial = heat.stored + heat.latent;
    return heat;
  }

  double Sites::total_mass() const
  {
    cases::CompensatedSum sum;
    for(std::size_t a = 0; a < n; ++a)
      if(!is_dirichlet[a])
      {
        sum.add(liquid.mass[a]);
        sum.add(ice.mass[a]);
      }
    return sum.value();
  }

  double Sites::total_of(std::size_t solute) const
  {
    cases::CompensatedSum sum;
    for(std::size_t a = 0; a < n; ++a)
      sum.add(concentration[solute][a] * site_mass);
    return sum.value();
  }
} // namespace meltfront::particles
