#include <cases/scene.h>
#include <particles/alloy/options.h>
#include <particles/sph/demand.h>
#include <particles/sph_two_population/parameters.h>
#include <particles/sph_two_population/sph_two_population.h>
#include <particles/sph_two_population/two_population_run.h>

namespace meltfront::particles
{
  namespace
  {
    using cases::BoundaryKind, cases::Effect;

    class TwoPopulationMethod : public cases::Method
    {
    public:
      explicit TwoPopulationMethod(const TwoPopulationPolicy &policy)
        : Method(policy.name, policy.summary, policy.corrected_form)
        , policy(policy)
      {
      }

      /** The paper has no eutectic. Pure substances, whose front's origin could be told,
       * are refused: two populations are told apart by the solute between them. */
      std::vector<cases::Capabilities> capabilities() const override
      {
        std::vector<Effect> effects{Effect::phase_change,
                                    Effect::phase_conductivity,
                                    Effect::phase_heat_capacity,
                                    Effect::wall_temperature,
                                    Effect::solute,
                                    Effect::solute_diffusion};
        if(!policy.as_published)
          effects.push_back(Effect::eutectic);
        return {
            alloy_capabilities(std::move(effects),
                               {BoundaryKind::insulated, BoundaryKind::fixed_temperature},
                               {BoundaryKind::insulated}, {}, 1)};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(TwoPopulationParameters(policy));
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        return sph_demand(
            resolve_two_population_parameters(policy, scene, resolution).sph, scene,
            {.per_particle = 900, .per_neighbour = 60});
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        return make_two_population_run(policy, scene, effects, resolution);
      }

    private:
      const TwoPopulationPolicy &policy;
    };
  } // namespace

  std::unique_ptr<cases::Method> make_sph_two_population()
  {
    return std::make_unique<TwoPopulationMethod>(corrected_two_population());
  }

  std::unique_ptr<cases::Method> make_sph_two_population_2005()
  {
    return std::make_unique<TwoPopulationMethod>(published_two_population());
  }
} // namespace meltfront::particles
