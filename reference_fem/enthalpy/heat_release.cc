#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/heat_release.h>
#include <reference_fem/enthalpy/sum_over.h>

namespace meltfront::reference_fem
{
  HeatRelease::HeatRelease(const cases::Scene &scene,
                           const Discretization &discretization)
    : density(*scene.heat_release)
    , mesh(discretization)
  {
  }

  double HeatRelease::add_load(const StepFormula &step, std::vector<double> &load)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    return sum_over(mesh.volume,
                    [&](std::size_t i)
                    {
                      const double released
                          = step.c * density(mesh.positions[i], step.next);
                      load[i] += mesh.volume[i] * released;
                      return released;
                    });
  }
} // namespace meltfront::reference_fem
