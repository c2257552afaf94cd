#include <particles/sph/wall_exchange.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    std::vector<const cases::Boundary *> boundaries_of(const ConductionRows &rows)
    {
      std::vector<const cases::Boundary *> result;
      for(const WallLink &link : rows.exchange_links)
        result.push_back(rows.exchange_points[link.point].boundary);
      return result;
    }
  } // namespace

  WallExchange::WallExchange(const Discretisation &discretisation,
                             const ConductionRows &rows)
    : material(discretisation.scene.material)
    , sharp_latent_heat(material.curves ? material.curves->jump() : material.latent_heat)
    , spacing(discretisation.spacing)
    , links(rows.exchange_links)
    , depths(rows.exchange_depths)
    , boundaries(boundaries_of(rows))
    , values(discretisation.scene, rows.exchange_points, links)
  {
  }

  void WallExchange::prepare_step(double begin, double end)
  {
    meter.measure_setup([&] { values.average_step(begin, end); });
  }

  WallExchange::Layer WallExchange::layer(std::size_t link, double enthalpy,
                                          double ambient) const
  {
    const double depth = depths[link];
    if(material.curves)
    {
      // Within half a spacing the conductivity is the particle's to first order.
      const cases::ThermalState state = material.curves->at_enthalpy(enthalpy);
      const double jump = material.curves->jump();
      return enthalpy < 0 || enthalpy > jump
                 ? Layer{state.temperature, depth / state.conductivity,
                         1 / state.capacity, 0}
                 : melting_layer(link, enthalpy, ambient);
    }
    if(enthalpy < 0 || enthalpy > material.latent_heat)
    {
      const cases::PhaseProperties &phase
          = enthalpy < 0 ? material.solid : material.liquid;
      return {material.temperature(enthalpy), depth / phase.conductivity,
              1 / phase.specific_heat_capacity, 0};
    }
    return melting_layer(link, enthalpy, ambient);
  }

  WallExchange::Layer WallExchange::melting_layer(std::size_t link, double enthalpy,
                                                  double ambient) const
  {
    const double latent = sharp_latent_heat, depth = depths[link];
    // Cold surroundings freeze it from the wall on, warm ones melt it.
    const bool freezes = ambient < material.melting_temperature;
    const double changed
        = latent > 0 ? freezes ? 1 - enthalpy / latent : enthalpy / latent : 0.5;
    const double conductivity = (freezes ? material.solid : material.liquid).conductivity;
    const double thickness = depth + (changed - 0.5) * spacing;
    const double growth = latent > 0 && thickness > 0
                              ? (freezes ? -1 : 1) * spacing / (latent * conductivity)
                              : 0;
    return {material.melting_temperature, std::max(thickness, 0.) / conductivity, 0,
            growth};
  }

  double WallExchange::add(double fraction, std::span<const double> enthalpy,
                           std::span<double> flow, double flow_scale)
  {
    return meter.measure(
        [&]
        {
          double sum = 0;
          for(std::size_t i = 0; i < links.size(); ++i)
          {
            const WallLink &link = links[i];
            const double ambient = values.at(link.point, fraction);
            const Layer behind = layer(i, enthalpy[link.row], ambient);
            const double heat
                = link.strength
                  * cases::heat_through_layer(*boundaries[i], ambient, behind.temperature,
                                              behind.resistance)
                        .flux
                  / flow_scale;
            flow[link.row] += heat;
            sum += heat;
          }
          return sum;
        });
  }

  void WallExchange::differentiate(double fraction, std::span<const double> enthalpy,
                                   std::span<double> diagonal, double flow_scale) const
  {
    for(std::size_t i = 0; i < links.size(); ++i)
    {
      const WallLink &link = links[i];
      const double ambient = values.at(link.point, fraction);
      const Layer behind = layer(i, enthalpy[link.row], ambient);
      const cases::HeatThroughLayer through = cases::heat_through_layer(
          *boundaries[i], ambient, behind.temperature, behind.resistance);
      diagonal[link.row]
          += link.strength
             * (through.slope * behind.warming + through.by_resistance * behind.growth)
             / flow_scale;
    }
  }

  cases::EffectCost WallExchange::cost(cases::Effect effect) const
  {
    const auto kind = effect == cases::Effect::robin_wall
                          ? cases::BoundaryKind::heat_transfer
                          : cases::BoundaryKind::radiation;
    const auto of_kind = static_cast<std::size_t>(
        std::ranges::count_if(boundaries, [&](const cases::Boundary *boundary)
                              { return boundary->kind == kind; }));
    return meter.cost(
        effect,
        of_kind * (sizeof(WallLink) + sizeof(double) + sizeof(const cases::Boundary *))
            + values.bytes());
  }
} // namespace meltfront::particles
