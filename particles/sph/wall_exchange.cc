#include <cases/error.h>
#include <particles/sph/wall_exchange.h>

#include <algorithm>
#include <cmath>

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
    : own(discretisation.own)
    , material(discretisation.scene.material)
    , sharp_latent_heat(material.curves ? material.curves->jump() : material.latent_heat)
    , links(rows.exchange_links)
    , depths(rows.exchange_depths)
    , boundaries(boundaries_of(rows))
    , values(discretisation.scene, rows.exchange_points, links)
  {
    if(discretisation.layout != LatticeLayout::cell_centred)
      throw cases::Refusal("particles on the walls (layout = edge) exchange no heat with "
                           "surroundings; layout = cell does");
    for(const PlaneWall &wall : discretisation.walls)
      cells_across.push_back({wall.boundary, discretisation.cell[wall.direction]});
    for(const RoundWall &wall : discretisation.round_walls)
      cells_across.push_back({wall.boundary, discretisation.spacing});
    if(discretisation.scene.domain.outline)
      cells_across.push_back(
          {&discretisation.scene.boundary(cases::Side::outer), discretisation.spacing});
  }

  double WallExchange::cell_across(const cases::Boundary &wall) const
  {
    return std::ranges::find(cells_across, &wall, &CellAcross::wall)->thickness;
  }

  void WallExchange::prepare_step(double begin, double end)
  {
    meter.measure_setup([&] { values.average_step(begin, end); });
  }

  WallExchange::Layer WallExchange::layer(const cases::Boundary &wall, double depth,
                                          double enthalpy, double ambient) const
  {
    if(material.curves)
    {
      // Within half a spacing the conductivity is the particle's to first order.
      const cases::ThermalState state = material.curves->at_enthalpy(enthalpy);
      const double jump = material.curves->jump();
      return enthalpy < 0 || enthalpy > jump
                 ? Layer{state.temperature, depth / state.conductivity,
                         1 / state.capacity, 0}
                 : melting_layer(wall, depth, enthalpy, ambient);
    }
    if(enthalpy < 0 || enthalpy > material.latent_heat)
    {
      const cases::PhaseProperties &phase
          = enthalpy < 0 ? material.solid : material.liquid;
      return {material.temperature(enthalpy), depth / phase.conductivity,
              1 / phase.specific_heat_capacity, 0};
    }
    return melting_layer(wall, depth, enthalpy, ambient);
  }

  WallExchange::Layer WallExchange::melting_layer(const cases::Boundary &wall,
                                                  double depth, double enthalpy,
                                                  double ambient) const
  {
    const double cell = cell_across(wall);
    const double latent = sharp_latent_heat;
    // Cold surroundings freeze it from the wall on, warm ones melt it.
    const bool freezes = ambient < material.melting_temperature;
    const double changed
        = latent > 0 ? freezes ? 1 - enthalpy / latent : enthalpy / latent : 0.5;
    const double conductivity = (freezes ? material.solid : material.liquid).conductivity;
    const double thickness = depth + (changed - 0.5) * cell;
    const double growth = latent > 0 && thickness > 0
                              ? (freezes ? -1 : 1) * cell / (latent * conductivity)
                              : 0;
    return {material.melting_temperature, std::max(thickness, 0.) / conductivity, 0,
            growth};
  }

  WallExchange::Exchange WallExchange::exchange(const cases::Boundary &wall, double depth,
                                                double enthalpy, double ambient) const
  {
    const Layer own_layer = layer(wall, depth, enthalpy, ambient);
    const cases::HeatThroughLayer through = cases::heat_through_layer(
        wall, ambient, own_layer.temperature, own_layer.resistance);
    const Exchange plain{through.flux, through.slope * own_layer.warming
                                           + through.by_resistance * own_layer.growth};
    const double latent = sharp_latent_heat, melting = material.melting_temperature;
    const bool freezes = enthalpy > latent && ambient < melting;
    const bool melts = enthalpy < 0 && ambient > melting;
    if(!(latent > 0) || !(freezes || melts))
      return plain;
    const double conductivity = (freezes ? material.solid : material.liquid).conductivity;
    const double from_front
        = cases::heat_through_layer(wall, ambient, melting, depth / 2 / conductivity)
              .flux;
    const double excess = from_front - through.flux;
    if(!(std::abs(from_front) > std::abs(through.flux)))
      return plain;
    const double sensible = freezes ? enthalpy - latent : -enthalpy;
    const double share = latent / std::max(latent, sensible);
    const double share_rate
        = sensible > latent ? (freezes ? -1 : 1) * share / sensible : 0;
    return {through.flux + share * excess,
            (1 - share) * plain.rate + share_rate * excess};
  }

  double WallExchange::add(double fraction, std::span<const double> enthalpy,
                           std::span<double> flow, double flow_scale)
  {
    return add(
        [&](std::size_t row, const cases::Boundary &wall, double ambient, double depth)
        { return exchange(wall, depth, enthalpy[row], ambient).flux; },
        fraction, flow, flow_scale);
  }

  void WallExchange::differentiate(double fraction, std::span<const double> enthalpy,
                                   std::span<double> diagonal, double flow_scale) const
  {
    differentiate(
        [&](std::size_t row, const cases::Boundary &wall, double ambient, double depth)
        { return exchange(wall, depth, enthalpy[row], ambient).rate; },
        fraction, diagonal, flow_scale);
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
