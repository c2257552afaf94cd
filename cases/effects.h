#ifndef meltfront_cases_effects_h
#define meltfront_cases_effects_h

#include <cstddef>
#include <string>
#include <vector>

namespace meltfront::cases
{
  struct Scene;

  /** A piece of physics that a scene may call for. */
  enum class Effect
  {
    phase_change,           ///< latent heat is exchanged
    phase_conductivity,     ///< the phases conduct differently
    phase_heat_capacity,    ///< the phases store heat differently
    heat_sources,           ///< point or line sources and sinks
    wall_temperature,       ///< a wall with a prescribed temperature
    wall_flux,              ///< a wall with a prescribed heat flux
    liquid_motion,          ///< freezing displaces liquid because the densities differ
    metastable_phase,       ///< a phase lies beyond the melting temperature
    solute,                 ///< dissolved substance lowers the melting temperature
    solute_diffusion,       ///< solute spreads in the liquid
    eutectic,               ///< what is left of the liquid freezes at one temperature
    volumetric_source,      ///< heat is released throughout the domain
    inclusion,              ///< a region conducts otherwise than the rest
    robin_wall,             ///< a wall exchanges heat with its surroundings
    radiating_wall,         ///< a wall radiates heat to its surroundings
    gibbs_thomson,          ///< a curved front melts at another temperature
    variable_conductivity,  ///< a phase's conductivity depends on temperature
    variable_heat_capacity, ///< a phase's heat capacity depends on temperature
    melting_range,          ///< the material is partly solid between two temperatures
    moving_source,          ///< a point or line source moves
    gravity,                ///< weight of a solid's particles, whose effects begin here
    base,                   ///< a floor throws particles back
    hot_base,      ///< a part of the floor throws them back faster than they came
    point_heating, ///< a source drives particles away from itself
    drag,          ///< the velocities of particles fade
    heat_bath,     ///< particles are in a bath of a temperature
    light          ///< light heats the particles that are not in the shadow of others
  };
  inline constexpr auto n_effects = static_cast<std::size_t>(Effect::light) + 1;

  /** The word for an effect in case files and tables, `phase_change` and so on. */
  const char *to_string(Effect effect);

  /** One sentence on what the effect is. */
  const char *description(Effect effect);

  /** All effects, in the order of the enumeration. */
  const std::vector<Effect> &all_effects();

  /** What a case file says of an effect. */
  enum class EffectChoice
  {
    automatic,
    on,
    off
  };

  /** Whether an effect is simulated, and why. */
  struct EffectDecision
  {
    Effect effect;
    bool on;
    std::string reason; ///< one sentence
  };

  /** A decision for every effect that the kind of problem knows. */
  class EffectSet
  {
  public:
    explicit EffectSet(std::vector<EffectDecision> decisions);

    bool contains(Effect effect) const;

    const std::vector<EffectDecision> &decisions() const;

  private:
    std::vector<EffectDecision> list;
  };

  /**
   * Derive from the scene itself which effects it calls for; a choice of `on` or `off` in
   * Scene::effect_choices overrides the rule and says so in the reason.
   */
  EffectSet effects_called_for(const Scene &scene);

  /**
   * The scene with the physics of every effect that is off taken out: phases that no
   * longer differ get the solid's properties, sources vanish, walls become insulated,
   * latent heat becomes zero. What methods are handed, so that `off` means the same for
   * all of them.
   */
  Scene simulated_scene(const Scene &scene, const EffectSet &effects);
} // namespace meltfront::cases

#endif
