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

    EffectDecision decide(Effect effect, bool on, const std::string &why,
                          const std::string &why_not)
    {
      return {effect, on, on ? why : why_not};
    }

    EffectDecision phase_change(const Scene &scene)
    {
      return decide(
          Effect::phase_change, scene.material.latent_heat > 0,
          fmt::format("the latent heat is {:.6g} J/kg", scene.material.latent_heat),
          "the material has no latent heat");
    }

    constexpr const char *at_melting = " (at the melting temperature)";

    EffectDecision phase_conductivity(const Scene &scene)
    {
      const double solid = scene.material.solid.conductivity;
      const double liquid = scene.material.liquid.conductivity;
      const bool curves_differ = scene.material.solid.conductivity_curve
                                 != scene.material.liquid.conductivity_curve;
      return decide(Effect::phase_conductivity, solid != liquid || curves_differ,
                    fmt::format("the solid conducts {:.6g} W/(m K), the liquid {:.6g}{}",
                                solid, liquid, curves_differ ? at_melting : ""),
                    fmt::format("both phases conduct {:.6g} W/(m K)", solid));
    }

    EffectDecision phase_heat_capacity(const Scene &scene)
    {
      const double solid = scene.material.solid.specific_heat_capacity;
      const double liquid = scene.material.liquid.specific_heat_capacity;
      const bool curves_differ = scene.material.solid.heat_capacity_curve
                                 != scene.material.liquid.heat_capacity_curve;
      return decide(Effect::phase_heat_capacity, solid != liquid || curves_differ,
                    fmt::format("the solid stores {:.6g} J/(kg K), the liquid {:.6g}{}",
                                solid, liquid, curves_differ ? at_melting : ""),
                    fmt::format("both phases store {:.6g} J/(kg K)", solid));
    }

    EffectDecision heat_sources(const Scene &scene)
    {
      return decide(Effect::heat_sources, !scene.sources.empty(),
                    fmt::format("there {} {} point or line source{}",
                                scene.sources.size() == 1 ? "is" : "are",
                                scene.sources.size(),
                                scene.sources.size() == 1 ? "" : "s"),
                    "there is no source");
    }

    EffectDecision walls(const Scene &scene, Effect effect, BoundaryKind kind,
                         const char *what)
    {
      std::string names;
      for(const Side side : scene.sides())
        if(scene.boundary(side).kind == kind)
          names += fmt::format("{}{}", names.empty() ? "" : ", ", to_string(side));
      return decide(effect, !names.empty(),
                    fmt::format("{} is prescribed on {}", what, names),
                    fmt::format("no wall prescribes {}", what));
    }

    EffectDecision wall_temperature(const Scene &scene)
    {
      return walls(scene, Effect::wall_temperature, BoundaryKind::fixed_temperature,
                   "a temperature");
    }

    EffectDecision wall_flux(const Scene &scene)
    {
      return walls(scene, Effect::wall_flux, BoundaryKind::flux, "a heat flux");
    }

    EffectDecision liquid_motion(const Scene &scene)
    {
      const double solid = scene.material.solid.density;
      const double liquid = scene.material.liquid.density;
      return decide(
          Effect::liquid_motion, solid != liquid,
          fmt::format("the solid's density is {:.6g} kg/m^3, the liquid's {:.6g}", solid,
                      liquid),
          fmt::format("both phases have the density {:.6g} kg/m^3", solid));
    }

    /**
     * The initial front, where the scene states one, leaves solid or liquid on the wrong
     * side of the melting temperature. Sampled; the temperature of a similarity solution
     * that keeps one phase at the melting point may miss it by round-off.
     */
    EffectDecision metastable_phase(const Scene &scene)
    {
      const char *phase = metastable_initial_phase(scene);
      return decide(Effect::metastable_phase, phase != nullptr,
                    fmt::format("{} at the start", phase ? phase : ""),
                    "no phase is beyond the melting temperature at the start");
    }

    /** The solutes of which there is some at the start. */
    std::string solutes_present(const Scene &scene)
    {
      std::string names;
      for(std::size_t s = 0; scene.alloy && s < scene.alloy->solutes.size(); ++s)
        if(initially_present(scene, s))
          names += fmt::format("{}{}", names.empty() ? "" : ", ",
                               scene.alloy->solutes[s].name);
      return names;
    }

    EffectDecision solute(const Scene &scene)
    {
      const std::string present = solutes_present(scene);
      return decide(Effect::solute, !present.empty(),
                    fmt::format("the melt holds {}", present),
                    scene.alloy ? "the alloy holds no solute at the start"
                                : "the substance is pure");
    }

    EffectDecision solute_diffusion(const Scene &scene)
    {
      bool diffuses = false;
      for(std::size_t s = 0; scene.alloy && s < scene.alloy->solutes.size(); ++s)
        diffuses
            |= scene.alloy->solutes[s].diffusivity > 0 && initially_present(scene, s);
      return decide(Effect::solute_diffusion, diffuses,
                    "solute that the melt holds diffuses",
                    "no solute that the melt holds diffuses");
    }

    EffectDecision eutectic(const Scene &scene)
    {
      if(solutes_present(scene).empty())
        return decide(Effect::eutectic, false, {}, "there is no solute");
      const double temperature = scene.alloy->eutectic_temperature;
      const double coldest = temperature_bounds(scene).lower;
      return decide(
          Effect::eutectic, coldest < temperature,
          fmt::format("the scene may fall below the eutectic temperature {:.6g}",
                      temperature),
          std::isfinite(temperature)
              ? fmt::format("the scene stays above the eutectic temperature "
                            "{:.6g}",
                            temperature)
              : "the alloy has no eutectic temperature");
    }

    EffectDecision volumetric_source(const Scene &scene)
    {
      return decide(
          Effect::volumetric_source, scene.volumetric_source.has_value(),
          fmt::format("heat is released throughout the domain: {}",
                      scene.volumetric_source ? scene.volumetric_source->expression : ""),
          "no heat is released throughout the domain");
    }

    EffectDecision inclusion(const Scene &scene)
    {
      const double outside = scene.material.solid.conductivity;
      const double inside = scene.inclusion ? scene.inclusion->conductivity : outside;
      return decide(Effect::inclusion, inside != outside,
                    fmt::format("a region conducts {:.6g} W/(m K), the rest {:.6g}",
                                inside, outside),
                    scene.inclusion ? "the inclusion conducts as the rest"
                                    : "there is none");
    }

    EffectDecision robin_wall(const Scene &scene)
    {
      return walls(scene, Effect::robin_wall, BoundaryKind::heat_transfer,
                   "an exchange of heat");
    }

    EffectDecision radiating_wall(const Scene &scene)
    {
      return walls(scene, Effect::radiating_wall, BoundaryKind::radiation,
                   "an exchange of heat by radiation");
    }

    EffectDecision gibbs_thomson(const Scene &scene)
    {
      const double coefficient = scene.material.gibbs_thomson_coefficient;
      return decide(
          Effect::gibbs_thomson, coefficient != 0,
          fmt::format("the Gibbs-Thomson coefficient is {:.6g} K m", coefficient),
          "the melting temperature does not depend on curvature");
    }

    EffectDecision varies(Effect effect, const Material &material, const char *what,
                          std::shared_ptr<const PropertyCurve> PhaseProperties::*curve)
    {
      std::string words;
      for(const auto &[phase, name] :
          {std::pair(&material.solid, "solid"), std::pair(&material.liquid, "liquid")})
        if(phase->*curve)
          words += fmt::format("{}that of the {} is {}", words.empty() ? "" : ", ", name,
                               (phase->*curve)->words());
      return decide(effect, !words.empty(),
                    fmt::format("the {} depends on temperature: {}", what, words),
                    fmt::format("no {} depends on temperature", what));
    }

    EffectDecision variable_conductivity(const Scene &scene)
    {
      return varies(Effect::variable_conductivity, scene.material, "conductivity",
                    &PhaseProperties::conductivity_curve);
    }

    EffectDecision variable_heat_capacity(const Scene &scene)
    {
      return varies(Effect::variable_heat_capacity, scene.material, "heat capacity",
                    &PhaseProperties::heat_capacity_curve);
    }

    EffectDecision melting_range(const Scene &scene)
    {
      const auto &range = scene.material.melting_range;
      return decide(Effect::melting_range, range != nullptr,
                    range ? fmt::format("the material is partly solid from {:.6g} to "
                                        "{:.6g} ({})",
                                        range->solidus, range->liquidus, range->words)
                          : "",
                    "the material melts at one temperature");
    }

    EffectDecision moving_source(const Scene &scene)
    {
      std::string paths;
      for(const PointSource &source : scene.sources)
        if(source.path)
          paths
              += fmt::format("{}{}", paths.empty() ? "" : "; ", source.path->expression);
      return decide(Effect::moving_source, !paths.empty(),
                    fmt::format("a source moves: {}", paths), "no source moves");
    }

    EffectDecision gravity(const Scene &scene)
    {
      const double gravity = scene.particle_solid->gravity;
      return decide(Effect::gravity, gravity != 0,
                    fmt::format("particles fall with {:.6g}", gravity),
                    "there is no gravity");
    }

    EffectDecision base(const Scene &scene)
    {
      return decide(Effect::base, scene.particle_solid->base.has_value(),
                    "there is a floor", "there is no floor");
    }

    EffectDecision hot_base(const Scene &scene)
    {
      const auto &floor = scene.particle_solid->base;
      return decide(Effect::hot_base, floor && floor->hot, "a part of the floor is hot",
                    "no part of a floor is hot");
    }

    EffectDecision point_heating(const Scene &scene)
    {
      return decide(Effect::point_heating, scene.particle_solid->heating.has_value(),
                    "there is a source that drives particles away",
                    "there is no such source");
    }

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
         phase_change, [](Scene &scene) { scene.material.latent_heat = 0; }},
        {Effect::phase_conductivity, "phase_conductivity",
         "The phases conduct heat differently.", phase_conductivity,
         [](Scene &scene)
         {
           PhaseProperties &liquid = scene.material.liquid;
           liquid.conductivity = scene.material.solid.conductivity;
           liquid.conductivity_curve = scene.material.solid.conductivity_curve;
         }},
        {Effect::phase_heat_capacity, "phase_heat_capacity",
         "The phases store heat differently.", phase_heat_capacity,
         [](Scene &scene)
         {
           PhaseProperties &liquid = scene.material.liquid;
           liquid.specific_heat_capacity = scene.material.solid.specific_heat_capacity;
           liquid.heat_capacity_curve = scene.material.solid.heat_capacity_curve;
         }},
        {Effect::heat_sources, "heat_sources", "Point or line sources and sinks of heat.",
         heat_sources, [](Scene &scene) { scene.sources.clear(); }},
        {Effect::wall_temperature, "wall_temperature",
         "Walls with a prescribed temperature.", wall_temperature,
         [](Scene &scene) { insulate(scene, BoundaryKind::fixed_temperature); }},
        {Effect::wall_flux, "wall_flux", "Walls with a prescribed heat flux.", wall_flux,
         [](Scene &scene) { insulate(scene, BoundaryKind::flux); }},
        {Effect::liquid_motion, "liquid_motion",
         "Freezing displaces liquid because the phases' densities differ.", liquid_motion,
         [](Scene &scene)
         { scene.material.liquid.density = scene.material.solid.density; }},
        {Effect::metastable_phase, "metastable_phase",
         "A phase lies beyond the melting temperature: undercooled liquid or superheated "
         "solid, which only a tracked front can hold.",
         metastable_phase, [](Scene &) {}},
        {Effect::solute, "solute",
         "A dissolved substance lowers the melting temperature; crystals reject it.",
         solute,
         [](Scene &scene)
         {
           scene.alloy.reset();
           scene.initial.concentration.clear();
         }},
        {Effect::solute_diffusion, "solute_diffusion", "Solute spreads in the liquid.",
         solute_diffusion,
         [](Scene &scene)
         {
           if(scene.alloy)
             for(Solute &solute : scene.alloy->solutes)
               solute.diffusivity = 0;
         }},
        {Effect::eutectic, "eutectic",
         "What is left of the liquid freezes at the eutectic temperature.", eutectic,
         [](Scene &scene)
         {
           if(scene.alloy)
             scene.alloy->eutectic_temperature = Alloy().eutectic_temperature;
         }},
        {Effect::volumetric_source, "volumetric_source",
         "Heat released throughout the domain.", volumetric_source,
         [](Scene &scene) { scene.volumetric_source.reset(); }},
        {Effect::inclusion, "inclusion",
         "A region that conducts otherwise than the rest.", inclusion,
         [](Scene &scene) { scene.inclusion.reset(); }},
        {Effect::robin_wall, "robin_wall",
         "Walls that exchange heat with their surroundings.", robin_wall,
         [](Scene &scene) { insulate(scene, BoundaryKind::heat_transfer); }},
        {Effect::radiating_wall, "radiating_wall",
         "Walls that radiate heat to their surroundings, by the fourth power of the "
         "absolute temperature.",
         radiating_wall, [](Scene &scene) { insulate(scene, BoundaryKind::radiation); }},
        {Effect::gibbs_thomson, "gibbs_thomson",
         "The melting temperature of a curved front is lowered or raised.", gibbs_thomson,
         [](Scene &scene) { scene.material.gibbs_thomson_coefficient = 0; }},
        {Effect::variable_conductivity, "variable_conductivity",
         "A phase's conductivity depends on temperature; off: it is that at the melting "
         "temperature.",
         variable_conductivity,
         [](Scene &scene)
         {
           for(PhaseProperties *phase : {&scene.material.solid, &scene.material.liquid})
             phase->conductivity_curve.reset();
         }},
        {Effect::variable_heat_capacity, "variable_heat_capacity",
         "A phase's heat capacity depends on temperature; off: it is that at the melting "
         "temperature.",
         variable_heat_capacity,
         [](Scene &scene)
         {
           for(PhaseProperties *phase : {&scene.material.solid, &scene.material.liquid})
             phase->heat_capacity_curve.reset();
         }},
        {Effect::melting_range, "melting_range",
         "The material is partly solid between two temperatures; off: it melts half way "
         "between them.",
         melting_range,
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
         moving_source,
         [](Scene &scene)
         {
           for(PointSource &source : scene.sources)
             source.path.reset();
         }},
        {Effect::gravity, "gravity", "Particles of a solid have weight.", gravity,
         [](Scene &scene) { scene.particle_solid->gravity = 0; }},
        {Effect::base, "base", "A floor throws particles back.", base,
         [](Scene &scene) { scene.particle_solid->base.reset(); }},
        {Effect::hot_base, "hot_base",
         "A part of the floor throws particles back with another speed.", hot_base,
         [](Scene &scene)
         {
           if(scene.particle_solid->base)
             scene.particle_solid->base->hot.reset();
         }},
        {Effect::point_heating, "point_heating",
         "A source drives particles away from itself.", point_heating,
         [](Scene &scene) { scene.particle_solid->heating.reset(); }}};
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
