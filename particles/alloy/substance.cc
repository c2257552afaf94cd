#include <cases/error.h>
#include <cases/snapshot.h>
#include <particles/alloy/substance.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    std::vector<std::size_t> solutes_present(const cases::Scene &scene)
    {
      std::vector<std::size_t> numbers;
      for(std::size_t s = 0; scene.alloy && s < scene.alloy->solutes.size(); ++s)
        if(cases::initially_present(scene, s))
          numbers.push_back(s);
      if(numbers.size() > cases::most_solutes)
        throw cases::InputError(fmt::format("an alloy has at most {} solutes, not {}",
                                            cases::most_solutes, numbers.size()));
      return numbers;
    }

    cases::Alloy with_solutes(const cases::Scene &scene,
                              const std::vector<std::size_t> &numbers)
    {
      cases::Alloy result = scene.alloy.value_or(cases::Alloy());
      result.solutes.clear();
      for(const std::size_t s : numbers)
      {
        result.solutes.push_back(scene.alloy->solutes[s]);
        if(!(result.solutes.back().diffusivity >= 0))
          throw cases::InputError(fmt::format("the diffusivity of {} is {} m^2/s; it "
                                              "must not be negative",
                                              result.solutes.back().name,
                                              result.solutes.back().diffusivity));
      }
      return result;
    }
  } // namespace

  AlloySubstance::AlloySubstance(const cases::Scene &scene, const std::string &method)
    : material(scene.material)
    , density(scene.material.solid.density)
    , numbers(solutes_present(scene))
    , alloy(with_solutes(scene, numbers))
    , diagram(material, alloy)
    , expansion(alloy.crystal_density > 0 ? density / alloy.crystal_density : 1)
    , eutectic_excess(alloy.eutectic_temperature - material.melting_temperature)
  {
    if(numbers.empty())
      return;
    const double coldest = cases::temperature_bounds(scene).lower;
    const double lowest
        = std::max(coldest - material.melting_temperature, eutectic_excess);
    const double difference
        = material.liquid.specific_heat_capacity - material.solid.specific_heat_capacity;
    // Without a lower bound the run itself must not go so far.
    const double heat = std::isfinite(lowest)
                            ? material.latent_heat + difference * std::min(lowest, 0.)
                            : material.latent_heat;
    if(!(heat > 0))
      throw cases::Refusal(fmt::format(
          "{} needs crystals of an alloy to give off heat as they grow; at {:.6g} it is "
          "{:.6g} J/kg",
          method, material.melting_temperature + lowest, heat));
  }

  bool AlloySubstance::diffuses() const
  {
    return std::any_of(alloy.solutes.begin(), alloy.solutes.end(),
                       [](const cases::Solute &solute)
                       { return solute.diffusivity > 0; });
  }

  double AlloySubstance::largest_conductivity() const
  {
    return std::max(material.solid.conductivity, material.liquid.conductivity);
  }

  double AlloySubstance::least_heat_capacity() const
  {
    return std::min(material.solid.specific_heat_capacity,
                    material.liquid.specific_heat_capacity);
  }
} // namespace meltfront::particles
