#ifndef meltfront_reference_fem_enthalpy_wall_flux_h
#define meltfront_reference_fem_enthalpy_wall_flux_h

#include <cases/method.h>
#include <cases/time_integral.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/time_scheme.h>

#include <vector>

namespace meltfront::reference_fem
{
  /** The effect wall_flux: a heat flux into the domain (W/m^2), taken at the wall's
   * nodes. The heat of a step is the time scheme's own difference quotient of the flux's
   * integral over time, so that what has come in is this integral. */
  class WallFlux
  {
  public:
    WallFlux(const cases::Scene &scene, const Discretisation &discretisation);

    /** Add the heat of a step to the load vector; returns the sum of what is added (J).
     */
    double add_load(const StepFormula &step, std::vector<double> &load);

    const cases::EffectCost &cost() const
    {
      return effect_cost;
    }

  private:
    struct Wall
    {
      cases::StepIntegrals flux;
      std::vector<WallNode> nodes;
    };
    std::vector<Wall> walls;
    cases::EffectCost effect_cost{cases::Effect::wall_flux};
  };
} // namespace meltfront::reference_fem

#endif
