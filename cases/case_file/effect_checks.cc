#include <cases/case_file/effect_checks.h>
#include <cases/case_file/prm_scan.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

namespace meltfront::cases
{
  namespace
  {
    /** What an effect acts on, and what is said where a scene has none of it. */
    struct Need
    {
      Effect effect;
      bool fulfilled;
      std::string missing;
    };

    Need key(const PrmFile &prm, Effect effect, const std::string &subsection,
             const std::string &name)
    {
      return {effect, prm.given(subsection, name),
              fmt::format("{} is missing", name_of_key(subsection, name))};
    }

    Need part(Effect effect, bool there, const std::string &subsection)
    {
      return {effect, there, fmt::format("there is no subsection '{}'", subsection)};
    }

    Need wall(const Scene &scene, Effect effect, BoundaryKind kind,
              const std::string &words)
    {
      return {effect,
              std::ranges::any_of(scene.sides(), [&scene, kind](Side side)
                                  { return scene.boundary(side).kind == kind; }),
              fmt::format("no wall in subsection 'Scene/Walls' has the kind {}", words)};
    }
  } // namespace

  void check_effects(const PrmFile &prm, const Scene &scene)
  {
    const std::string material = "Scene/Material", liquid = material + "/Liquid",
                      initial = "Scene/Initial state";
    const std::string solute = material + "/Solute ";
    Need front = key(prm, Effect::metastable_phase, initial, "front");
    front.missing += ", which alone can leave a phase beyond the melting temperature";
    Need diffusivity = key(prm, Effect::solute_diffusion, solute + "1", "diffusivity");
    diffusivity.fulfilled |= prm.given(solute + "2", "diffusivity");
    const Need needs[] = {
        part(Effect::heat_sources, !scene.sources.empty(), "Scene/Source 1"),
        wall(scene, Effect::wall_temperature, BoundaryKind::fixed_temperature,
             "'fixed temperature' or 'exact'"),
        wall(scene, Effect::wall_flux, BoundaryKind::flux, "'flux'"),
        wall(scene, Effect::robin_wall, BoundaryKind::heat_transfer, "'heat transfer'"),
        wall(scene, Effect::radiating_wall, BoundaryKind::radiation, "'radiation'"),
        front,
        key(prm, Effect::gibbs_thomson, material, "Gibbs-Thomson coefficient"),
        {Effect::variable_conductivity,
         scene.material.solid.conductivity_curve
             || scene.material.liquid.conductivity_curve,
         "no conductivity is an expression of T or a table"},
        {Effect::variable_heat_capacity,
         scene.material.solid.heat_capacity_curve
             || scene.material.liquid.heat_capacity_curve,
         "no specific heat capacity is an expression of T or a table"},
        key(prm, Effect::melting_range, material, "solidus temperature"),
        {Effect::moving_source,
         std::ranges::any_of(scene.sources, [](const PointSource &source)
                             { return source.path.has_value(); }),
         "no position of a source is an expression of t"},
        key(prm, Effect::phase_conductivity, liquid, "conductivity"),
        key(prm, Effect::phase_heat_capacity, liquid, "specific heat capacity"),
        key(prm, Effect::liquid_motion, liquid, "density"),
        part(Effect::solute, scene.alloy.has_value(), solute + "1"),
        diffusivity,
        key(prm, Effect::eutectic, material + "/Alloy", "eutectic temperature"),
        part(Effect::volumetric_source, scene.volumetric_source.has_value(),
             "Scene/Volumetric source"),
        part(Effect::inclusion, scene.inclusion.has_value(), "Scene/Inclusion")};
    for(const Need &need : needs)
    {
      const auto choice = scene.effect_choices.find(need.effect);
      if(choice != scene.effect_choices.end() && choice->second == EffectChoice::on
         && !need.fulfilled)
        throw prm.error("Effects", to_string(need.effect),
                        fmt::format("is on but {}", need.missing));
    }
  }

  double read_effect_tolerance(const PrmFile &prm)
  {
    constexpr const char *key = "effects", *automatic = "auto", *within = "auto within ";
    const std::string text = prm.get_text("", key);
    if(text == automatic)
      return 0;
    double tolerance = 0;
    if(text.starts_with(within))
    {
      const char *from = text.data() + std::strlen(within),
                 *end = text.data() + text.size();
      const auto [rest, error] = std::from_chars(from, end, tolerance);
      if(error != std::errc() || rest != end)
        tolerance = 0;
    }
    if(!(tolerance > 0 && tolerance < 1))
      throw prm.error("", key,
                      fmt::format("must be 'auto' or 'auto within TOLERANCE', a number "
                                  "between 0 and 1, not '{}'",
                                  text));
    return tolerance;
  }
} // namespace meltfront::cases
