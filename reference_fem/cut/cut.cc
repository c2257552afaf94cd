#include <reference_fem/cut/cut.h>

#include <cases/error.h>
#include <reference_fem/cut/options.h>
#include <reference_fem/cut/run.h>

namespace meltfront::reference_fem
{
  namespace
  {
    class FemCut : public cases::Method
    {
    public:
      std::string name() const override
      {
        return "fem-cut";
      }

      std::string summary() const override
      {
        return "Sharp front that cuts a fixed mesh (deal.II): level set, Nitsche's "
               "condition, ghost penalty; fronts merge and split.";
      }

      std::vector<cases::Effect> supported_effects() const override
      {
        using cases::Effect;
        return {Effect::phase_change,        Effect::phase_conductivity,
                Effect::phase_heat_capacity, Effect::heat_sources,
                Effect::wall_temperature,    Effect::wall_flux};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cut::cut_options();
      }

      cases::Cost solve(const cases::Scene &scene, const cases::EffectSet &effects,
                        const cases::Resolution &resolution,
                        cases::Observer &observer) const override
      {
        cases::require_effects(*this, effects);
        if(scene.domain.outline)
          throw cases::Refusal("fem-cut does not simulate what an outline bounds: its "
                               "rims are circles");
        return cut::CutRun(scene, effects, resolution).run(observer);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_fem_cut()
  {
    return std::make_unique<FemCut>();
  }
} // namespace meltfront::reference_fem
