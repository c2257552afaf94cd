#include <cases/effect_decisions.h>
#include <cases/scene.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases::called_for
{
  namespace
  {
    EffectDecision decide(Effect effect, bool on, const std::string &why,
                          const std::string &why_not)
    {
      return {effect, on, on ? why : why_not};
    }

    EffectDecision walls(const Scene &scene, Effect effect, BoundaryKind kind,
                         const char *what)
    {
      std::string names;
      for(const Side side : scene.sides())
        if(scene.boundary(side).kind == kind)
          names += fmt::format("{}{}", names.empty() ? "" : ", ",
                               name_of(scene.domain, side));
      return decide(effect, !names.empty(),
                    fmt::format("{} is prescribed on {}", what, names),
                    fmt::format("no wall prescribes {}", what));
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
  } // namespace

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
                              scene.sources.size(), scene.sources.size() == 1 ? "" : "s"),
                  "there is no source");
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
    return decide(Effect::liquid_motion, solid != liquid,
                  fmt::format("the solid's density is {:.6g} kg/m^3, the liquid's {:.6g}",
                              solid, liquid),
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

  EffectDecision solute(const Scene &scene)
  {
    const std::string present = solutes_present(scene);
    return decide(
        Effect::solute, !present.empty(), fmt::format("the melt holds {}", present),
        scene.alloy ? "the alloy holds no solute at the start" : "the substance is pure");
  }

  EffectDecision solute_diffusion(const Scene &scene)
  {
    bool diffuses = false;
    for(std::size_t s = 0; scene.alloy && s < scene.alloy->solutes.size(); ++s)
      diffuses |= scene.alloy->solutes[s].diffusivity > 0 && initially_present(scene, s);
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
    return decide(Effect::eutectic, coldest < temperature,
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
    return decide(
        Effect::inclusion, inside != outside,
        fmt::format("a region conducts {:.6g} W/(m K), the rest {:.6g}", inside, outside),
        scene.inclusion ? "the inclusion conducts as the rest" : "there is none");
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
    return decide(Effect::gibbs_thomson, coefficient != 0,
                  fmt::format("the Gibbs-Thomson coefficient is {:.6g} K m", coefficient),
                  "the melting temperature does not depend on curvature");
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
        paths += fmt::format("{}{}", paths.empty() ? "" : "; ", source.path->expression);
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

  EffectDecision drag(const Scene &scene)
  {
    const double drag = scene.particle_solid->drag;
    return decide(Effect::drag, drag > 0,
                  fmt::format("velocities fade by {:.6g} per time", drag),
                  "nothing slows particles down");
  }

  EffectDecision heat_bath(const Scene &scene)
  {
    return decide(Effect::heat_bath, scene.particle_solid->bath.has_value(),
                  "particles are in a bath", "there is no bath");
  }

  EffectDecision light(const Scene &scene)
  {
    return decide(Effect::light, scene.particle_solid->light.has_value(),
                  "light falls on the particles", "it is dark");
  }
} // namespace meltfront::cases::called_for
