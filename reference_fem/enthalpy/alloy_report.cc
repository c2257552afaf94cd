#include <reference_fem/enthalpy/alloy_solver.h>
#include <reference_fem/enthalpy/sum_over.h>

#include <algorithm>

namespace meltfront::reference_fem
{
  using cases::Effect;

  bool AlloySolver::concentrations_hold() const
  {
    constexpr double round_off = 1e-13;
    for(const Substance &substance : substances)
      for(const double value : substance.in_use())
        if(!(value >= -round_off))
          return false;
    return true;
  }

  cases::TemperatureBounds AlloySolver::bounds(cases::TemperatureBounds of_scene) const
  {
    if(diffusion)
      for(const Composition &node : composition)
        of_scene.lower = std::min(of_scene.lower, scene.material.melting_temperature
                                                      + graph.liquidus(node));
    return of_scene;
  }

  void AlloySolver::report(cases::Snapshot &snapshot)
  {
    for(Substance &substance : substances)
    {
      substance.at_sites.resize(mesh.node_of_site.size());
      for(std::size_t site = 0; site < mesh.node_of_site.size(); ++site)
        substance.at_sites[site] = substance.now[mesh.node_of_site[site]];
      snapshot.concentration[substance.index] = substance.at_sites;
      snapshot.solute[substance.index] = {mass_of(substance), substance.initial_mass};
    }
  }

  long AlloySolver::work() const
  {
    return newton->work() + linear_solver->work() + (diffusion ? diffusion->work() : 0);
  }

  NonlinearSolver::GraphCost AlloySolver::graph_cost() const
  {
    return newton->graph_cost();
  }

  std::optional<cases::EffectCost> AlloySolver::cost(Effect effect) const
  {
    switch(effect)
    {
    case Effect::solute:
      return solute_cost;
    case Effect::solute_diffusion:
    {
      if(!diffusion)
        return cases::EffectCost{effect};
      cases::EffectCost result = diffusion->cost();
      result.bytes += mixing->bytes()
                      + static_cast<long>((used.size() + found.size() + 3 * liquid.size())
                                          * sizeof(double));
      return result;
    }
    case Effect::phase_conductivity:
      return cases::EffectCost{effect, solute_cost.calls,
                               conduction ? conduction->bytes() : 0};
    default:
      return {};
    }
  }
} // namespace meltfront::reference_fem
