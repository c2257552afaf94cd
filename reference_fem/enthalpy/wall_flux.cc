#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/wall_flux.h>

namespace meltfront::reference_fem
{
  WallFlux::WallFlux(const cases::Scene &scene, const Discretization &discretization)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    for(const cases::Side side : scene.sides())
    {
      const cases::Boundary &boundary = scene.boundary(side);
      if(boundary.kind != cases::BoundaryKind::flux)
        continue;
      walls.push_back(
          {boundary.value, discretization.walls[static_cast<std::size_t>(side)]});
      effect_cost.bytes += static_cast<long>(
          sizeof(Wall) + walls.back().nodes.size() * sizeof(WallNode));
    }
  }

  double WallFlux::add_load(const StepFormula &step, std::vector<double> &load)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    double sum = 0;
    for(const Wall &wall : walls)
      for(const WallNode &node : wall.nodes)
      {
        const double heat = step.c * node.area * wall.flux(node.position, step.next);
        load[node.node] += heat;
        sum += heat;
      }
    return sum;
  }
} // namespace meltfront::reference_fem
