#include <verification/studies/crosscheck/scene_maker.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace meltfront::verification
{
  void SceneMaker::make_alloy_of_substance()
  {
    substance.liquid_density = substance.solid_density;
    const double loss = 20 * substance.temperature_scale
                        * std::abs(substance.liquid_capacity - substance.solid_capacity);
    if(loss > substance.latent_heat / 2)
      substance.liquid_capacity = substance.solid_capacity;
  }

  void SceneMaker::choose_material()
  {
    if(problem == Problem::steady)
      draft.set("Scene/Material/Solid", "conductivity",
                words(substance.solid_conductivity));
    else
      write_substance(substance, changes_phase(), draft);
    if(problem == Problem::pure && dimension == 2 && random.chance(0.02))
      draft.set("Scene/Material", "Gibbs-Thomson coefficient",
                words(0.01 * substance.temperature_scale * substance.length));
  }

  void SceneMaker::choose_inclusion()
  {
    if(!random.chance(0.2))
      return;
    const double length = substance.length;
    const std::string here = "Scene/Inclusion";
    const std::string middle = words(length * random.uniform(0.3, 0.6));
    const std::string distance
        = shape == "slab"  ? fmt::format("abs(x - {})", middle)
          : shape == "box" ? fmt::format("sqrt((x - {})^2 + (y - {})^2)", middle, middle)
                           : coordinate;
    draft.set(here, "level set",
              fmt::format("{} - {}", distance,
                          words(first + (length - first) * random.uniform(0.1, 0.3))));
    draft.set(here, "conductivity",
              words(substance.solid_conductivity * random.log_uniform(1e-2, 1e2)));
  }

  void SceneMaker::vary_properties()
  {
    if(!random.chance(0.12) || draft.has("Scene/Inclusion"))
      return;
    const double melting = substance.melting_temperature;
    const double scale = substance.temperature_scale;
    for(const std::string phase : {"Scene/Material/Solid", "Scene/Material/Liquid"})
      for(const std::string key : {"conductivity", "specific heat capacity"})
      {
        const std::string constant = draft.value(phase, key);
        if(constant.empty() || !random.chance(0.5))
          continue;
        // Known wherever sources and fluxes may drive the temperature.
        const double value = std::strtod(constant.c_str(), nullptr), far = 1e6 * scale;
        std::string table = fmt::format("{}: {}", words(melting - far), constant);
        for(const double shares : {-1., -0.3, 0., 0.4, 1.})
          table += fmt::format(", {}: {}", words(melting + shares * scale, 12),
                               words(value * random.log_uniform(0.5, 2)));
        draft.set(phase, key,
                  table + fmt::format(", {}: {}", words(melting + far), constant),
                  {constant});
      }
  }

  void SceneMaker::spread_melting()
  {
    const std::string here = "Scene/Material";
    const bool starts_sharp
        = !draft.value(initial, "front").empty()
          || !draft.value(initial, "solid fraction at melting").empty()
          || !draft.value(here, "Gibbs-Thomson coefficient").empty();
    if(starts_sharp || !random.chance(0.1))
      return;
    const double scale = substance.temperature_scale;
    const double solidus
        = rounded(substance.melting_temperature - scale * random.uniform(0.05, 0.4));
    const double liquidus = rounded(solidus + scale * random.uniform(0.1, 0.6));
    draft.remove(here, "melting temperature");
    draft.set(here, "solidus temperature", words(solidus));
    draft.set(here, "liquidus temperature", words(liquidus));
    if(random.chance(0.6))
      return;
    const bool rest = random.chance(0.5); // freezes at the solidus
    const double middle = solidus + random.uniform(0.2, 0.8) * (liquidus - solidus);
    draft.set(here, "solid fraction",
              fmt::format("{}: {}, {}: {}, {}: 0", words(solidus, 12),
                          rest ? words(random.uniform(0.6, 0.95)) : "1",
                          words(middle, 12), words(random.uniform(0.1, 0.5)),
                          words(liquidus, 12)),
              {"linear"});
  }

  void SceneMaker::choose_solute()
  {
    // The coldest mush of these scenes is three scales below the melting point: its
    // liquid holds less than its own mass of solute.
    const double slope = rounded(substance.temperature_scale * random.log_uniform(5, 40));
    const std::string here = "Scene/Material/Solute 1";
    draft.set(here, "name", "salt");
    draft.set(here, "liquidus", words(slope));
    if(random.chance(0.3))
      draft.set(here, "diffusivity",
                words(substance.diffusivity() * random.log_uniform(1e-3, 1e-1)));
    draft.set(initial, "concentration",
              words(substance.temperature_scale * random.uniform(0.05, 0.4) / slope));
    if(unbounded || random.chance(0.25))
      draft.set("Scene/Material/Alloy", "eutectic temperature",
                words(substance.melting_temperature - slope * random.uniform(0.15, 0.4)));
  }
} // namespace meltfront::verification
