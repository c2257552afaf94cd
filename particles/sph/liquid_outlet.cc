#include <cases/wall_law.h>
#include <particles/sph/liquid_outlet.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  using cases::BoundaryKind;

  namespace
  {
    /** Least depth of a particle that all but lies on the wall, in spacings. */
    constexpr double least_depth = 0.2;

    /** The nearest place of the outlet, and how far it is. */
    std::pair<cases::Position, double> nearest_on_outlet(const cases::Domain &domain,
                                                         cases::Position place)
    {
      if(!domain.round())
      {
        const double depth = domain.upper[0] - place[0];
        place[0] = domain.upper[0];
        for(int d = domain.dimension; d < 3; ++d)
          place[d] = 0; // within the strip that stands for a slab
        return {place, depth};
      }
      const double distance = std::hypot(place[0], place[1], place[2]);
      for(double &x : place)
        x *= domain.radius / distance;
      return {place, domain.radius - distance};
    }
  } // namespace

  LiquidOutlet::LiquidOutlet(const LiquidBalance &balance, const Discretisation &dis,
                             const ConductionRows &conduction)
    : scene(balance.at_rest)
    , wall(scene.boundary(balance.outlet))
  {
    for(const WallLink &link : conduction.temperature_links)
    {
      if(list.empty() || list.back().particle != link.row)
      {
        const auto [place, depth]
            = nearest_on_outlet(scene.domain, dis.particles.point(link.row));
        list.push_back(
            {link.row, 0, std::max(depth, least_depth * dis.spacing), place, 1, 0});
      }
      list.back().strength += link.strength;
    }
  }

  void LiquidOutlet::follow(double time, std::span<const double> enthalpy)
  {
    const cases::Material &material = scene.material;
    const double capacity = material.liquid.volumetric_heat_capacity();
    const auto sensible = [&](double temperature)
    { return capacity * std::max(temperature - material.melting_temperature, 0.); };
    for(Opening &opening : list)
      if(wall.kind == BoundaryKind::fixed_temperature)
      {
        opening.own_share = 0;
        opening.given = sensible(wall.value(opening.place, time));
      }
      else if(cases::prescribes_heat(wall.kind))
      {
        const double own = material.temperature(enthalpy[opening.particle]);
        const double resistance = opening.depth / material.liquid.conductivity;
        const double flux = cases::heat_through_layer(
                                wall, wall.value(opening.place, time), own, resistance)
                                .flux;
        opening.given = sensible(own + resistance * flux) - sensible(own);
      }
  }

  std::vector<std::uint32_t> LiquidOutlet::particles() const
  {
    std::vector<std::uint32_t> result;
    for(const Opening &opening : list)
      result.push_back(opening.particle);
    return result;
  }

  std::vector<double> LiquidOutlet::strengths(std::size_t particles) const
  {
    std::vector<double> result(particles, 0.);
    for(const Opening &opening : list)
      result[opening.particle] += opening.strength;
    return result;
  }
} // namespace meltfront::particles
