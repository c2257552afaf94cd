#include <cases/scene.h>
#include <particles/sph/sph.h>
#include <particles/sph/sph_run.h>

namespace meltfront::particles
{
  namespace
  {
    class SphMethod : public cases::Method
    {
    public:
      explicit SphMethod(const SphPolicy &policy)
        : policy(policy)
      {
      }

      std::string name() const override
      {
        return policy.name;
      }

      std::string summary() const override
      {
        return policy.summary;
      }

      std::string corrected_form() const override
      {
        return policy.corrected_form;
      }

      std::vector<cases::Effect> supported_effects() const override
      {
        using cases::Effect;
        return {Effect::phase_change,        Effect::phase_conductivity,
                Effect::phase_heat_capacity, Effect::heat_sources,
                Effect::wall_temperature,    Effect::wall_flux,
                Effect::heat_release,        Effect::inclusion};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return sph_options(policy);
      }

      cases::Cost solve(const cases::Scene &scene, const cases::EffectSet &effects,
                        const cases::Resolution &resolution,
                        cases::Observer &observer) const override
      {
        cases::require_effects(*this, effects);
        // A run without options of its own uses the declared defaults.
        cases::Resolution complete = resolution;
        if(complete.options.declarations().empty())
          complete.options = cases::Options(option_declarations());
        return run_sph(policy, scene, effects, complete, observer);
      }

    private:
      const SphPolicy &policy;
    };
  } // namespace

  std::unique_ptr<cases::Method> make_sph()
  {
    return std::make_unique<SphMethod>(corrected_policy());
  }

  std::unique_ptr<cases::Method> make_sph_2005()
  {
    return std::make_unique<SphMethod>(published_policy());
  }
} // namespace meltfront::particles
