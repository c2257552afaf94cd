#ifndef meltfront_reference_fem_enthalpy_volumetric_source_h
#define meltfront_reference_fem_enthalpy_volumetric_source_h

#include <cases/method.h>
#include <cases/time_integral.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/time_scheme.h>

#include <vector>

namespace meltfront::reference_fem
{
  /** The effect volumetric_source: heat released throughout the domain (W/m^3), taken at
   * the nodes, each with its volume, over the step as a flux is (WallFlux). */
  class VolumetricSource
  {
  public:
    VolumetricSource(const cases::Scene &scene, const Discretisation &discretisation);

    /** Add the heat of a step to the load vector; returns the sum of what is added (J).
     */
    double add_load(const StepFormula &step, std::vector<double> &load);

    const cases::EffectCost &cost() const
    {
      return effect_cost;
    }

  private:
    cases::StepIntegrals density;
    const Discretisation &mesh;
    cases::EffectCost effect_cost{cases::Effect::volumetric_source};
  };
} // namespace meltfront::reference_fem

#endif
