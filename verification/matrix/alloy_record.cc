#include <cases/numbers.h>
#include <verification/matrix/alloy_record.h>
#include <verification/matrix/json_values.h>

#include <cmath>

namespace meltfront::verification
{
  AlloyRecord make_alloy_record(const cases::Scene &scene)
  {
    using cases::nan;
    const cases::Alloy &alloy = *scene.alloy;
    AlloyRecord record;
    for(std::size_t s = 0; s < alloy.solutes.size(); ++s)
    {
      const cases::Solute &solute = alloy.solutes[s];
      record.solutes.push_back({solute.name, solute.liquidus,
                                solute.liquidus_curve ? nan : solute.liquidus_slope,
                                solute.diffusivity,
                                s < scene.initial.concentration.size()
                                    ? scene.initial.concentration[s].expression
                                    : std::string()});
    }
    record.eutectic_temperature
        = std::isfinite(alloy.eutectic_temperature) ? alloy.eutectic_temperature : nan;
    record.crystal_density = alloy.crystal_density > 0 ? alloy.crystal_density
                                                       : scene.material.liquid.density;
    return record;
  }

  void to_json(nlohmann::json &json, const AlloyRecord &record)
  {
    nlohmann::json solutes = nlohmann::json::array();
    for(const SoluteRecord &solute : record.solutes)
      solutes.push_back({{"name", solute.name},
                         {"liquidus", solute.liquidus},
                         {"liquidus_slope", json_of(solute.liquidus_slope)},
                         {"diffusivity", json_of(solute.diffusivity)},
                         {"concentration", solute.concentration}});
    json = {{"solutes", solutes},
            {"eutectic_temperature", json_of(record.eutectic_temperature)},
            {"crystal_density", json_of(record.crystal_density)}};
  }

  void from_json(const nlohmann::json &json, AlloyRecord &record)
  {
    record = {};
    for(const auto &solute : json.at("solutes"))
      record.solutes.push_back({solute.at("name"), solute.at("liquidus"),
                                number_in(solute.at("liquidus_slope")),
                                number_in(solute.at("diffusivity")),
                                solute.at("concentration")});
    record.eutectic_temperature = number_in(json.at("eutectic_temperature"));
    record.crystal_density = number_in(json.at("crystal_density"));
  }
} // namespace meltfront::verification
