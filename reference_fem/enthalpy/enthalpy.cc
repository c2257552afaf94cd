#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/enthalpy/options.h>
#include <reference_fem/enthalpy/solver.h>

namespace meltfront::reference_fem
{
  namespace
  {
    class FemEnthalpy : public cases::Method
    {
    public:
      std::string name() const override
      {
        return "fem-enthalpy";
      }

      std::string summary() const override
      {
        return "Enthalpy method with linear finite elements (deal.II): the exact "
               "enthalpy "
               "graph, solved by truncated nonsmooth Newton steps.";
      }

      std::vector<cases::Effect> supported_effects() const override
      {
        using cases::Effect;
        return {
            Effect::phase_change, Effect::phase_conductivity, Effect::phase_heat_capacity,
            Effect::heat_sources, Effect::wall_temperature,   Effect::wall_flux,
            Effect::solute,       Effect::solute_diffusion,   Effect::eutectic,
            Effect::heat_release, Effect::inclusion};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return enthalpy_options();
      }

      cases::Cost solve(const cases::Scene &scene, const cases::EffectSet &effects,
                        const cases::Resolution &resolution,
                        cases::Observer &observer) const override
      {
        cases::require_effects(*this, effects);
        StepStatistics statistics;
        return run_enthalpy(scene, effects, resolution, observer, statistics);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_fem_enthalpy()
  {
    return std::make_unique<FemEnthalpy>();
  }
} // namespace meltfront::reference_fem
