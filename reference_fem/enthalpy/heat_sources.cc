#include <cases/error.h>
#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/heat_sources.h>

#include <cmath>

namespace meltfront::reference_fem
{
  HeatSources::HeatSources(const cases::Scene &scene, const Mesh &mesh,
                           const Discretisation &discretisation)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    for(const cases::PointSource &source : scene.sources)
    {
      if(scene.domain.shape == cases::DomainShape::slab && discretisation.dimension > 1)
        throw cases::Refusal(
            "fem-enthalpy simulates the sources of a slab in one dimension only");
      if(discretisation.measure != cases::Symmetry::none)
        for(const double x : source.position)
          if(std::abs(x) > 1e-12 * scene.domain.radius)
            throw cases::Refusal("a source away from the centre is not symmetric: "
                                 "fem-enthalpy needs the option dimension for it");
      sources.push_back({source.energy, mesh.shares(source.position)});
      effect_cost.bytes += static_cast<long>(sizeof(Source));
      effect_cost.bytes += static_cast<long>(sources.back().shares.size()
                                             * sizeof(std::pair<unsigned int, double>));
    }
  }

  void HeatSources::add_load(const StepFormula &step, std::vector<double> &load)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    for(const Source &source : sources)
    {
      const double heat
          = source.energy(step.next)
            - step.combine(source.energy(step.now), source.energy(step.before));
      for(const auto &[node, share] : source.shares)
        load[node] += share * heat;
    }
  }

  double HeatSources::energy(double time) const
  {
    double sum = 0;
    for(const Source &source : sources)
      sum += source.energy(time);
    return sum;
  }
} // namespace meltfront::reference_fem
