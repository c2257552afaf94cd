#include <particles/sph/wall_temperature.h>

namespace meltfront::particles
{
  namespace
  {
    /** Points for the links of free particles, then one per particles on Dirichlet walls.
     */
    std::vector<WallPoint> all_points(const Discretisation &dis,
                                      const ConductionRows &rows,
                                      std::vector<WallLink> &links)
    {
      std::vector<WallPoint> points = rows.temperature_points;
      links = rows.temperature_links;
      for(const std::uint32_t row : dis.dirichlet)
        for(const PlaneWall &wall : dis.walls)
          if(wall.boundary->kind == cases::BoundaryKind::fixed_temperature
             && dis.on_wall(wall, row))
          {
            links.push_back({row, static_cast<std::uint32_t>(points.size()), 0.});
            points.push_back({wall.boundary, wall.project(dis.particles.point(row))});
            break; // a corner belongs to one wall
          }
      return points;
    }

    /** Add up neighbouring links of one row to one point. */
    std::vector<WallLink> merged(std::span<const WallLink> links)
    {
      std::vector<WallLink> result;
      for(const WallLink &link : links)
      {
        bool found = false;
        for(auto other = result.rbegin();
            other != result.rend() && other->row == link.row; ++other)
          if(other->point == link.point)
          {
            other->strength += link.strength;
            found = true;
            break;
          }
        if(!found)
          result.push_back(link);
      }
      return result;
    }
  } // namespace

  WallTemperature::WallTemperature(const Discretisation &dis, const ConductionRows &rows,
                                   const ConductionVariable &variable)
    : own(dis.own)
    , variable(variable)
    , material(dis.scene.material)
    , dirichlet(dis.dirichlet)
    , values(dis.scene, all_points(dis, rows, links), links)
  {
    const std::size_t free = links.size() - dirichlet.size();
    dirichlet_links.assign(links.begin() + free, links.end());
    links = merged(std::span(links).first(free));
    for(const std::uint32_t row : dirichlet)
      dirichlet_weights.push_back(dis.weights[row] * material.solid.density);
    wall_variable.resize(values.size());
  }

  void WallTemperature::prepare_step(double begin, double end)
  {
    meter.measure_setup([&] { values.prepare_step(begin, end); });
  }

  double WallTemperature::hold(double fraction, std::span<double> enthalpy)
  {
    return hold(fraction, enthalpy,
                [this](std::uint32_t, double temperature)
                { return material.enthalpy(temperature); });
  }

  cases::EffectCost WallTemperature::cost() const
  {
    return meter.cost(cases::Effect::wall_temperature,
                      (links.size() + dirichlet_links.size()) * sizeof(WallLink)
                          + dirichlet.size() * (sizeof(std::uint32_t) + sizeof(double))
                          + wall_variable.size() * sizeof(double) + values.bytes());
  }
} // namespace meltfront::particles
