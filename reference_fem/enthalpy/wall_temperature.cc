#include <cases/stopwatch.h>
#include <cases/time_integral.h>
#include <reference_fem/enthalpy/wall_temperature.h>

#include <algorithm>

namespace meltfront::reference_fem
{
  WallTemperature::WallTemperature(const cases::Scene &scene,
                                   const Discretisation &discretisation)
    : melting_temperature(scene.material.melting_temperature)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    std::vector<char> taken(discretisation.volume.size());
    for(const cases::Side side : scene.sides())
    {
      const cases::Boundary &boundary = scene.boundary(side);
      if(boundary.kind != cases::BoundaryKind::fixed_temperature)
        continue;
      for(const WallNode &place : discretisation.walls[static_cast<std::size_t>(side)])
        if(!taken[place.node])
        {
          taken[place.node] = 1;
          nodes.push_back({place, temperatures.size()});
        }
      temperatures.push_back(boundary.value);
    }
    effect_cost.bytes = static_cast<long>(temperatures.size() * sizeof(cases::Field)
                                          + nodes.size() * sizeof(Node));
  }

  void WallTemperature::mark(std::vector<char> &free) const
  {
    for(const Node &node : nodes)
      free[node.place.node] = 0;
  }

  void WallTemperature::prescribe(const StepFormula &step, const NonlinearSolver &solver,
                                  CompensatedVector &u)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    for(Node &node : nodes)
    {
      node.temperature = cases::value_at_end(temperatures[node.wall], node.place.position,
                                             step.now, step.next);
      u.set(node.place.node, solver.kirchhoff(node.temperature - melting_temperature));
    }
  }

  double WallTemperature::react(const StepFormula &step, const StepProblem &problem,
                                const CompensatedVector &u,
                                const std::vector<double> &rhs,
                                std::vector<double> &enthalpy,
                                const EnthalpyAt &enthalpy_at)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    // Heat may pass in through one wall and out through another many times over what is
    // stored: the sum is that of the balance, which must hold to round-off of the stored.
    long double sum = 0;
    for(const Node &node : nodes)
    {
      const unsigned int i = node.place.node;
      enthalpy[i] = enthalpy_at(i, node.temperature, enthalpy[i]);
      sum += problem.volume[i] * enthalpy[i] - rhs[i]
             - step.c * problem.conduction.exact_inflow(i, u);
    }
    return static_cast<double>(sum);
  }
} // namespace meltfront::reference_fem
