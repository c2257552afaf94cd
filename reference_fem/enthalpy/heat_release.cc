#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/heat_release.h>
#include <reference_fem/enthalpy/step_means.h>
#include <reference_fem/enthalpy/sum_over.h>

namespace meltfront::reference_fem
{
  HeatRelease::HeatRelease(const cases::Scene &scene,
                           const Discretization &discretization)
    : density(*scene.heat_release, discretization.positions)
    , mesh(discretization)
  {
    effect_cost.bytes += static_cast<long>(density.bytes());
  }

  double HeatRelease::add_load(const StepFormula &step, std::vector<double> &load)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    const StepMeans means(step, density);
    return sum_over(mesh.volume,
                    [&](std::size_t i)
                    {
                      const double released = step.c * means.at(i, mesh.positions[i]);
                      load[i] += mesh.volume[i] * released;
                      return released;
                    });
  }
} // namespace meltfront::reference_fem
