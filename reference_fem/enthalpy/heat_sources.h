#ifndef meltfront_reference_fem_enthalpy_heat_sources_h
#define meltfront_reference_fem_enthalpy_heat_sources_h

#include <cases/method.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/time_scheme.h>

#include <functional>
#include <utility>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * The effect heat_sources: point and line sources as exact Dirac loads, shared by a
   * cell's nodes by the values of their shape functions at the source.
   *
   * The power of a step is the time scheme's own difference quotient of the energy, so
   * that the heat that has entered is PointSource::energy exactly.
   */
  class HeatSources
  {
  public:
    /**
     * @throws cases::Refusal where the discretisation's symmetry does not allow for the
     * source: away from the centre of a radial mesh, in a slab meshed in 2D or 3D
     */
    HeatSources(const cases::Scene &scene, const Mesh &mesh,
                const Discretisation &discretisation);

    /** Add the heat of a step to the load vector (J). */
    void add_load(const StepFormula &step, std::vector<double> &load);

    /** Heat from all sources since the start (J). */
    double energy(double time) const;

    const cases::EffectCost &cost() const
    {
      return effect_cost;
    }

  private:
    struct Source
    {
      std::function<double(double)> energy;
      std::vector<std::pair<unsigned int, double>> shares;
    };
    std::vector<Source> sources;
    cases::EffectCost effect_cost{cases::Effect::heat_sources};
  };
} // namespace meltfront::reference_fem

#endif
