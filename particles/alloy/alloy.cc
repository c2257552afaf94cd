#include <cases/error.h>
#include <cases/scene.h>
#include <particles/alloy/alloy.h>
#include <particles/alloy/mixture_run.h>
#include <particles/alloy/parameters.h>
#include <particles/alloy/two_population_run.h>

#include <fmt/format.h>

namespace meltfront::particles
{
  namespace
  {
    /** A run without options of its own uses the declared defaults. */
    cases::Resolution complete(const cases::Method &method,
                               const cases::Resolution &resolution)
    {
      cases::Resolution result = resolution;
      if(result.options.declarations().empty())
        result.options = cases::Options(method.option_declarations());
      return result;
    }

    class MixtureMethod : public cases::Method
    {
    public:
      std::string name() const override
      {
        return "sph-mixture";
      }

      std::string summary() const override
      {
        return "Smoothed particle hydrodynamics of alloys: each particle is a mixture of "
               "crystals and liquid in local equilibrium.";
      }

      std::vector<cases::Effect> supported_effects() const override
      {
        using cases::Effect;
        return {
            Effect::phase_change, Effect::phase_conductivity, Effect::phase_heat_capacity,
            Effect::heat_sources, Effect::wall_temperature,   Effect::wall_flux,
            Effect::solute,       Effect::solute_diffusion,   Effect::eutectic};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return mixture_options();
      }

      cases::Cost solve(const cases::Scene &scene, const cases::EffectSet &effects,
                        const cases::Resolution &resolution,
                        cases::Observer &observer) const override
      {
        cases::require_effects(*this, effects);
        return run_mixture(scene, effects, complete(*this, resolution), observer);
      }
    };
    class TwoPopulationMethod : public cases::Method
    {
    public:
      explicit TwoPopulationMethod(const TwoPopulationPolicy &policy)
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
        std::vector<Effect> effects{Effect::phase_change,
                                    Effect::phase_conductivity,
                                    Effect::phase_heat_capacity,
                                    Effect::wall_temperature,
                                    Effect::solute,
                                    Effect::solute_diffusion};
        if(!policy.as_published)
          effects.push_back(Effect::eutectic);
        return effects;
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return two_population_options(policy);
      }

      cases::Cost solve(const cases::Scene &scene, const cases::EffectSet &effects,
                        const cases::Resolution &resolution,
                        cases::Observer &observer) const override
      {
        if(policy.as_published && effects.contains(cases::Effect::eutectic))
          throw cases::Refusal(
              fmt::format("{} has no eutectic, for the paper has none: this needs {}",
                          policy.name, policy.corrected_form));
        cases::require_effects(*this, effects);
        return run_two_population(policy, scene, effects, complete(*this, resolution),
                                  observer);
      }

    private:
      const TwoPopulationPolicy &policy;
    };
  } // namespace

  std::unique_ptr<cases::Method> make_sph_mixture()
  {
    return std::make_unique<MixtureMethod>();
  }

  std::unique_ptr<cases::Method> make_sph_two_population()
  {
    return std::make_unique<TwoPopulationMethod>(corrected_two_population());
  }

  std::unique_ptr<cases::Method> make_sph_two_population_2005()
  {
    return std::make_unique<TwoPopulationMethod>(published_two_population());
  }
} // namespace meltfront::particles
