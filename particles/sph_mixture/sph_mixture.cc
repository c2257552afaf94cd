#include <cases/scene.h>
#include <particles/alloy/options.h>
#include <particles/sph/demand.h>
#include <particles/sph_mixture/mixture_run.h>
#include <particles/sph_mixture/parameters.h>
#include <particles/sph_mixture/sph_mixture.h>

namespace meltfront::particles
{
  namespace
  {
    using cases::BoundaryKind, cases::Effect, cases::FrontOrigin;

    class MixtureMethod : public cases::Method
    {
    public:
      MixtureMethod()
        : Method("sph-mixture",
                 "Smoothed particle hydrodynamics of alloys: each particle is a mixture "
                 "of crystals and liquid in local equilibrium.")
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        const std::vector<BoundaryKind> walls{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
            BoundaryKind::heat_transfer, BoundaryKind::radiation};
        return {alloy_capabilities(
            {Effect::phase_change, Effect::phase_conductivity,
             Effect::phase_heat_capacity, Effect::heat_sources, Effect::wall_temperature,
             Effect::wall_flux, Effect::robin_wall, Effect::radiating_wall,
             Effect::solute, Effect::solute_diffusion, Effect::eutectic},
            walls, walls,
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
  } // namespace

  std::unique_ptr<cases::Method> make_sph_mixture()
  {
    return std::make_unique<MixtureMethod>();
  }
} // namespace meltfront::particles
