#include <reference_fem/enthalpy/step_means.h>
#include <reference_fem/enthalpy/wall_exchange.h>

#include <algorithm>

namespace meltfront::reference_fem
{
  WallExchange::WallExchange(const cases::Scene &scene,
                             const Discretisation &discretisation,
                             const std::vector<char> &free)
    : transfer(discretisation.volume.size())
    , supply(discretisation.volume.size())
    , melting(scene.material.melting_temperature)
  {
    for(const cases::Side side : scene.sides())
    {
      const cases::Boundary &boundary = scene.boundary(side);
      if(!cases::exchanges_heat(boundary.kind))
        continue;
      const std::size_t first = places.size();
      std::vector<cases::Position> positions;
      for(const WallNode &node : discretisation.walls[static_cast<std::size_t>(side)])
        if(free[node.node])
        {
          places.push_back({node.node, node.area, &boundary});
          positions.push_back(node.position);
          nodes.push_back(node.node);
        }
      walls.push_back(
          {cases::StepIntegrals(boundary.value, positions), first, places.size()});
    }
    std::ranges::sort(nodes);
    const auto twice = std::ranges::unique(nodes);
    nodes.erase(twice.begin(), twice.end());
  }

  void WallExchange::begin(const StepFormula &step)
  {
    for(Wall &wall : walls)
    {
      const StepMeans means(step, wall.ambient);
      for(std::size_t i = wall.first; i < wall.last; ++i)
        places[i].ambient = means.at(i - wall.first);
    }
  }

  cases::EffectCost WallExchange::cost(cases::Effect effect) const
  {
    const auto kind = effect == cases::Effect::robin_wall
                          ? cases::BoundaryKind::heat_transfer
                          : cases::BoundaryKind::radiation;
    const auto of_kind = std::ranges::count_if(places, [&](const Place &place)
                                               { return place.boundary->kind == kind; });
    return {effect, calls,
            static_cast<long>(static_cast<std::size_t>(of_kind)
                                  * (sizeof(Place) + sizeof(unsigned int))
                              + 2 * transfer.size() * sizeof(double)),
            0};
  }
} // namespace meltfront::reference_fem
