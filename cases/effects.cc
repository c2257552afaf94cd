#include <cases/effect_decisions.h>
#include <cases/effects.h>
#include <cases/scene.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::cases
{
  namespace
  {
    /** One rule: the reason why a scene calls for the effect, or why it does not, and
     * what is taken out of a scene where it is off. */
    struct Rule
    {
      Effect effect;
      const char *name;
      const char *description;
      EffectDecision (*decide)(const Scene &);
      void (*leave_out)(Scene &);
    };

    /** Whether the kind of problem knows an effect: particle solids those from gravity
     * on, what conducts heat the others. */
    bool knows(const Scene &scene, Effect effect)
    {
      return effect >= Effect::gravity ? scene.problem == ProblemKind::particle_solid
                                       : scene.conducts_heat();
    }

    void insulate(Scene &scene, BoundaryKind kind)
    {
      for(auto &boundary : scene.boundaries)
        if(boundary && boundary->kind == kind)
          boundary = Boundary();
    }

    constexpr Rule rules[] = {
        {Effect::phase_change, "phase_change", "Latent heat is exchanged at the front.",
         called_for::phase_change, [](Scene &scene) { scene.material.latent_heat = 0; }},
        {Effect::phase_conductivity, "phase_conductivity",
         "The phases conduct heat differently.", called_for::phase_conductivity,
         [](Scene &scene)
         {
           PhaseProperties &liquid = scene.material.liquid;
           liquid.conductivity = scene.material.solid.conductivity;
           liquid.conductivity_curve = scene.material.solid.conductivity_curve;
         }},
        {Effect::phase_heat_capacity, "phase_heat_capacity",
         "The phases store heat differently.", called_for::phase_heat_capacity,
         [](Scene &scene)
         {
           PhaseProperties &liquid = scene.material.liquid;
           liquid.specific_heat_capacity = scene.material.solid.specific_heat_capacity;
           liquid.heat_capacity_curve = scene.material.solid.heat_capacity_curve;
         }},
        {Effect::heat_sources, "heat_sources", "Point or line sources and sinks of heat.",
         called_for::heat_sources, [](Scene &scene) { scene.sources.clear(); }},
        {Effect::wall_temperature, "wall_temperature",
         "Walls with a prescribed temperature.", called_for::wall_temperature,
         [](Scene &scene) { insulate(scene, BoundaryKind::fixed_temperature); }},
        {Effect::wall_flux, "wall_flux", "Walls with a prescribed heat flux.",
         called_for::wall_flux,
         [](Scene &scene) { insulate(scene, BoundaryKind::flux); }},
        {Effect::liquid_motion, "liquid_motion",
         "Freezing displaces liquid because the phases' densities differ.",
         called_for::liquid_motion,
         [](Scene &scene)
         { scene.material.liquid.density = scene.material.solid.density; }},
        {Effect::metastable_phase, "metastable_phase",
         "A phase lies beyond the melting temperature: undercooled liquid or superheated "
         "solid, which only a tracked front can hold.",
         called_for::metastable_phase, [](Scene &) {}},
        {Effect::solute, "solute",
         "A dissolved substance lowers the melting temperature; crystals reject it.",
         called_for::solute,
         [](Scene &scene)
         {
           scene.alloy.reset();
           scene.initial.concentration.clear();
         }},
        {Effect::solute_diffusion, "solute_diffusion", "Solute spreads in the liquid.",
         called_for::solute_diffusion,
         [](Scene &scene)
         {
           if(scene.alloy)
             for(Solute &solute : scene.alloy->solutes)
               solute.diffusivity = 0;
         }},
        {Effect::eutectic, "eutectic",
         "What is left of the liquid freezes at the eutectic temperature.",
         called_for::eutectic,
         [](Scene &scene)
         {
           if(scene.alloy)
             scene.alloy->eutectic_temperature = Alloy().eutectic_temperature;
         }},
        {Effect::volumetric_source, "volumetric_source",
         "Heat released throughout the domain.", called_for::volumetric_source,
         [](Scene &scene) { scene.volumetric_source.reset(); }},
        {Effect::inclusion, "inclusion",
         "A region that conducts otherwise than the rest.", called_for::inclusion,
         [](Scene &scene) { scene.inclusion.reset(); }},
        {Effect::robin_wall, "robin_wall",
         "Walls that exchange heat with their surroundings.", called_for::robin_wall,
         [](Scene &scene) { insulate(scene, BoundaryKind::heat_transfer); }},
        {Effect::radiating_wall, "radiating_wall",
         "Walls that radiate heat to their surroundings, by the fourth power of the "
         "absolute temperature.",
         called_for::radiating_wall,
         [](Scene &scene) { insulate(scene, BoundaryKind::radiation); }},
        {Effect::gibbs_thomson, "gibbs_thomson",
         "The melting temperature of a curved front is lowered or raised.",
         called_for::gibbs_thomson,
         [](Scene &scene) { scene.material.gibbs_thomson_coefficient = 0; }},
        {Effect::variable_conductivity, "variable_conductivity",
         "A phase's conductivity depends on temperature; off: it is that at the melting "
         "temperature.",
         called_for::variable_conductivity,
         [](Scene &scene)
         {
           for(PhaseProperties *phase : {&scene.material.solid, &scene.material.liquid})
             phase->conductivity_curve.reset();
         }},
        {Effect::variable_heat_capacity, "variable_heat_capacity",
         "A phase's heat capacity depends on temperature; off: it is that at the melting "
         "temperature.",
         called_for::variable_heat_capacity,
         [](Scene &scene)
         {
           for(PhaseProperties *phase : {&scene.material.solid, &scene.material.liquid})
             phase->heat_capacity_curve.reset();
         }},
        {Effect::melting_range, "melting_range",
         "The material is partly solid between two temperatures; off: it melts half way "
         "between them.",
         called_for::melting_range,
         [](Scene &scene)
         {
           Material &material = scene.material;
           if(material.melting_range)
             material.melting_temperature
                 = (material.melting_range->solidus + material.melting_range->liquidus)
                   / 2;
           material.melting_range.reset();
         }},
        {Effect::moving_source, "moving_source",
         "Point or line sources that move; off: they stay where they start.",
         called_for::moving_source,
         [](Scene &scene)
         {
           for(PointSource &source : scene.sources)
             source.path.reset();
         }},
        {Effect::gravity, "gravity", "Particles of a solid have weight.",
         called_for::gravity, [](Scene &scene) { scene.particle_solid->gravity = 0; }},
        {Effect::base, "base", "A floor throws particles back.", called_for::base,
         [](Scene &scene) { scene.particle_solid->base.reset(); }},
        {Effect::hot_base, "hot_base",
         "A part of the floor throws particles back with another speed.",
         called_for::hot_base,
         [](Scene &scene)
         {
           if(scene.particle_solid->base)
             scene.particle_solid->base->hot.reset();
         }},
        {Effect::point_heating, "point_heating",
         "A source drives particles away from itself.", called_for::point_heating,
         [](Scene &scene) { scene.particle_solid->heating.reset(); }},
        {Effect::drag, "drag", "Velocities of a solid's particles fade.",
         called_for::drag, [](Scene &scene) { scene.particle_solid->drag = 0; }},
        {Effect::heat_bath, "heat_bath",
         "A bath of a temperature gives heat to all particles or takes it.",
         called_for::heat_bath, [](Scene &scene) { scene.particle_solid->bath.reset(); }},
        {Effect::light, "light",
         "Light heats the particles that are not in the shadow of others.",
         called_for::light, [](Scene &scene) { scene.particle_solid->light.reset(); }}};
    static_assert(std::size(rules) == n_effects);

    const Rule &rule(Effect effect)
    {
      return rules[static_cast<std::size_t>(effect)];
    }
  } // namespace

  const char *to_string(Effect effect)
  {
    return rule(effect).name;
  }

  const char *description(Effect effect)
  {
    return rule(effect).description;
  }

  const std::vector<Effect> &all_effects()
  {
    static const std::vector<Effect> list = []
    {
      std::vector<Effect> effects;
      for(const Rule &r : rules)
        effects.push_back(r.effect);
      return effects;
    }();
    return list;
  }

  EffectSet::EffectSet(std::vector<EffectDecision> decisions)
    : list(std::move(decisions))
  {
  }

  bool EffectSet::contains(Effect effect) const
  {
    return std::any_of(list.begin(), list.end(),
                       [effect](const EffectDecision &decision)
                       { return decision.effect == effect && decision.on; });
  }

  const std::vector<EffectDecision> &EffectSet::decisions() const
  {
    return list;
  }

  EffectSet effects_called_for(const Scene &scene)
  {
    std::vector<EffectDecision> decisions;
    for(const Rule &r : rules)
    {
      if(!knows(scene, r.effect))
        continue;
      EffectDecision decision = r.decide(scene);
      const auto choice = scene.effect_choices.find(r.effect);
      if(choice != scene.effect_choices.end()
         && choice->second != EffectChoice::automatic)
      {
        decision.on = choice->second == EffectChoice::on;
        decision.reason = fmt::format("the case file says {} ({})",
                                      decision.on ? "on" : "off", decision.reason);
      }
      decisions.push_back(decision);
    }
    return EffectSet(std::move(decisions));
  }

  Scene simulated_scene(const Scene &scene, const EffectSet &effects)
  {
    Scene result = scene;
    for(const Rule &r : rules)
      if(knows(scene, r.effect) && !effects.contains(r.effect))
        r.leave_out(result);
    result.material.update_curves();
    return result;
  }
} // namespace meltfront::cases
