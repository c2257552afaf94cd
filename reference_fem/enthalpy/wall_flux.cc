#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/step_means.h>
#include <reference_fem/enthalpy/wall_flux.h>

namespace meltfront::reference_fem
{
  WallFlux::WallFlux(const cases::Scene &scene, const Discretisation &discretisation)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    for(const cases::Side side : scene.sides())
    {
      const cases::Boundary &boundary = scene.boundary(side);
      if(boundary.kind != cases::BoundaryKind::flux)
        continue;
      const std::vector<WallNode> &nodes
          = discretisation.walls[static_cast<std::size_t>(side)];
      std::vector<cases::Position> positions;
      for(const WallNode &node : nodes)
        positions.push_back(node.position);
      walls.push_back({cases::StepIntegrals(boundary.value, positions), nodes});
      effect_cost.bytes += static_cast<long>(
          sizeof(Wall) + nodes.size() * sizeof(WallNode) + walls.back().flux.bytes());
    }
  }

  double WallFlux::add_load(const StepFormula &step, std::vector<double> &load)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    double sum = 0;
    for(Wall &wall : walls)
    {
      const StepMeans means(step, wall.flux);
      for(std::size_t i = 0; i < wall.nodes.size(); ++i)
      {
        const WallNode &node = wall.nodes[i];
        const double heat = step.c * node.area * means.at(i);
        load[node.node] += heat;
        sum += heat;
      }
    }
    return sum;
  }
} // namespace meltfront::reference_fem
