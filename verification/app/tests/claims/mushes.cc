#include <verification/app/tests/claims/domains.h>
#include <verification/app/tests/claims/mushes.h>

#include <cases/exact/mushy_layer.h>

namespace meltfront::verification::claims
{
  namespace
  {
    using cases::Effect, cases::Position, cases::Side;

    /** Data of a mushy layer. */
    struct Mush
    {
      double slope = 4, diffusivity = 0;
      double eutectic = cases::Alloy().eutectic_temperature;
      double cold = -3;
      double latent_heat = 5;
      double liquid_conductivity = 1, liquid_heat_capacity = 1;
    };

    Trial mushy_layer(const Mush &mush, bool published)
    {
      constexpr double concentration = 0.25, far = 0;
      Trial trial;
      trial.scene = scene_on(domain_of(cases::DomainShape::slab, 1, false));
      cases::Scene &scene = trial.scene;
      scene.material.latent_heat = mush.latent_heat;
      scene.material.liquid.conductivity = mush.liquid_conductivity;
      scene.material.liquid.specific_heat_capacity = mush.liquid_heat_capacity;
      scene.end_time
          = mush.diffusivity > 0 ? 0.06 : 0.15; // before the far wall is reached
      scene.initial.temperature = cases::Field::uniform(far);
      scene.initial.concentration = {cases::Field::uniform(concentration)};
      cases::Solute solute;
      solute.name = "solute";
      solute.liquidus_slope = mush.slope;
      solute.diffusivity = mush.diffusivity;
      scene.alloy
          = cases::Alloy{.solutes = {solute}, .eutectic_temperature = mush.eutectic};
      using namespace cases::similarity;
      const auto layer = std::make_shared<cases::MushyLayer>(
          scene.material, *scene.alloy, std::vector<double>{concentration}, mush.cold,
          far, published ? HeatOfFreezing::constant : HeatOfFreezing::consistent,
          published ? MushConduction::published : MushConduction::mean);
      wall(scene, Side::x_min) = {.kind = cases::BoundaryKind::fixed_temperature,
                                  .value = cases::Field::uniform(mush.cold)};
      wall(scene, Side::x_max) = held_at([layer](const Position &p, double time)
                                         { return layer->temperature(p[0], time); });
      trial.judge = solution_judge(scene, layer);
      trial.n = 80;
      return trial;
    }
  } // namespace

  std::optional<EffectTrials> mush_trials(Effect effect, bool published)
  {
    Mush first, second;
    switch(effect)
    {
    case Effect::phase_change:
      second.latent_heat = 15;
      break;
    case Effect::phase_conductivity:
      second.liquid_conductivity = 4;
      break;
    case Effect::phase_heat_capacity:
      second.liquid_heat_capacity = 2.2;
      break;
    case Effect::wall_temperature:
      second.cold = -1.6;
      break;
    case Effect::solute:
      first.slope = 3;
      second.slope = 7;
      break;
    case Effect::solute_diffusion:
      second.diffusivity = 0.3;
      break;
    case Effect::eutectic:
      second.eutectic = -1.3;
      break;
    default:
      return {};
    }
    return EffectTrials{mushy_layer(first, published), mushy_layer(second, published)};
  }
} // namespace meltfront::verification::claims
