#include <cases/means_of_jumps.h>
#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/step_means.h>
#include <reference_fem/enthalpy/sum_over.h>
#include <reference_fem/enthalpy/volumetric_source.h>

namespace meltfront::reference_fem
{
  VolumetricSource::VolumetricSource(const cases::Scene &scene,
                                     const Discretisation &discretisation)
    : density(cases::mean_release(scene, discretisation.spacing),
              discretisation.positions)
    , mesh(discretisation)
  {
    effect_cost.bytes += static_cast<long>(density.bytes());
  }

  double VolumetricSource::add_load(const StepFormula &step, std::vector<double> &load)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    const StepMeans means(step, density);
    return sum_over(mesh.volume,
                    [&](std::size_t i)
                    {
                      const double released = step.c * means.at(i);
                      load[i] += mesh.volume[i] * released;
                      return released;
                    });
  }
} // namespace meltfront::reference_fem
