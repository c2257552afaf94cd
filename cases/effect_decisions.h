#ifndef meltfront_cases_effect_decisions_h
#define meltfront_cases_effect_decisions_h

#include <cases/effects.h>

/** Whether a scene calls for an effect, and the reason why or why not; those of particle
 * solids ask of Scene::particle_solid, which must be there. */
namespace meltfront::cases::called_for
{
  EffectDecision phase_change(const Scene &scene);
  EffectDecision phase_conductivity(const Scene &scene);
  EffectDecision phase_heat_capacity(const Scene &scene);
  EffectDecision heat_sources(const Scene &scene);
  EffectDecision wall_temperature(const Scene &scene);
  EffectDecision wall_flux(const Scene &scene);
  EffectDecision liquid_motion(const Scene &scene);
  EffectDecision metastable_phase(const Scene &scene);
  EffectDecision solute(const Scene &scene);
  EffectDecision solute_diffusion(const Scene &scene);
  EffectDecision eutectic(const Scene &scene);
  EffectDecision volumetric_source(const Scene &scene);
  EffectDecision inclusion(const Scene &scene);
  EffectDecision robin_wall(const Scene &scene);
  EffectDecision radiating_wall(const Scene &scene);
  EffectDecision gibbs_thomson(const Scene &scene);
  EffectDecision variable_conductivity(const Scene &scene);
  EffectDecision variable_heat_capacity(const Scene &scene);
  EffectDecision melting_range(const Scene &scene);
  EffectDecision moving_source(const Scene &scene);
  EffectDecision gravity(const Scene &scene);
  EffectDecision base(const Scene &scene);
  EffectDecision hot_base(const Scene &scene);
  EffectDecision point_heating(const Scene &scene);
  EffectDecision drag(const Scene &scene);
  EffectDecision heat_bath(const Scene &scene);
  EffectDecision light(const Scene &scene);
} // namespace meltfront::cases::called_for

#endif
