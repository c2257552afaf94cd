#include <reference_fem/fitted/fitted.h>

#include <cases/error.h>
#include <reference_fem/fitted/options.h>
#include <reference_fem/fitted/run.h>

namespace meltfront::reference_fem
{
  namespace
  {
    class FemFitted : public cases::Method
    {
    public:
      std::string name() const override
      {
        return "fem-fitted";
      }

      std::string summary() const override
      {
        return "Sharp front: finite elements (deal.II) on a mesh that moves with the "
               "front, "
               "in conservative form, with Newton's method for temperatures and front.";
      }

      std::vector<cases::Effect> supported_effects() const override
      {
        return cases::all_effects();
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return fitted::fitted_options();
      }

      cases::Cost solve(const cases::Scene &scene, const cases::EffectSet &effects,
                        const cases::Resolution &resolution,
                        cases::Observer &observer) const override
      {
        cases::require_effects(*this, effects);
        if(scene.domain.outline)
          throw cases::Refusal("fem-fitted does not simulate what an outline bounds: its "
                               "rays run from wall to wall of a slab, a box or a ball");
        return fitted::FittedRun(scene, effects, resolution).run(observer);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_fem_fitted()
  {
    return std::make_unique<FemFitted>();
  }
} // namespace meltfront::reference_fem
