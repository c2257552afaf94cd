#include <cases/error.h>
#include <cases/scene.h>
#include <particles/alloy/alloy.h>
#include <particles/alloy/mixture_run.h>
#include <particles/alloy/parameters.h>
#include <particles/alloy/two_population_run.h>
#include <particles/sph/demand.h>

#include <fmt/format.h>

namespace meltfront::particles
{
  namespace
  {
    using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::FrontOrigin;

    cases::Capabilities capabilities_of(std::vector<Effect> effects,
                                        std::vector<BoundaryKind> round_walls,
                                        std::vector<FrontOrigin> of_pure_substances,
                                        int most_threads)
    {
      std::vector<BoundaryKind> walls = round_walls;
      walls.push_back(BoundaryKind::periodic);
      return {.form = {},
              .problems = {cases::ProblemKind::stefan},
              .effects = std::move(effects),
              .shapes = {{DomainShape::slab, {1}, walls},
                         {DomainShape::box, {2, 3}, walls},
                         {DomainShape::ball, {2, 3}, std::move(round_walls)},
                         {DomainShape::outline, {2}, {BoundaryKind::insulated}}},
              .front_origins = std::move(of_pure_substances),
              .most_threads = most_threads};
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

      std::vector<cases::Capabilities> capabilities() const override
      {
        return {capabilities_of(
            {Effect::phase_change, Effect::phase_conductivity,
             Effect::phase_heat_capacity, Effect::heat_sources, Effect::wall_temperature,
             Effect::wall_flux, Effect::solute, Effect::solute_diffusion,
             Effect::eutectic},
            {BoundaryKind::insulated, BoundaryKind::fixed_temperature,
             BoundaryKind::flux},
            {FrontOrigin::none, FrontOrigin::initial_front, FrontOrigin::partly_melted,
             FrontOrigin::wall, FrontOrigin::source},
            cases::any_number_of_threads)};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(MixtureParameters());
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        return sph_demand(resolve_mixture_parameters(scene, resolution).sph, scene,
                          {.per_particle = 600, .per_neighbour = 40});
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        return make_mixture_run(scene, effects, resolution);
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
        return {capabilities_of(
            std::move(effects),
            {BoundaryKind::insulated, BoundaryKind::fixed_temperature}, {}, 1)};
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
