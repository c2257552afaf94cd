#include <verification/measure/checks/site_heat.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  double sensible_heat(const cases::Material &material, double temperature,
                       double solid_fraction)
  {
    if(material.curves)
    {
      const cases::ThermalState state = material.curves->at_temperature(temperature);
      return state.enthalpy - material.latent_heat * (1 - state.solid_fraction);
    }
    return (solid_fraction * material.solid.specific_heat_capacity
            + (1 - solid_fraction) * material.liquid.specific_heat_capacity)
           * (temperature - material.melting_temperature);
  }

  SiteHeat heat_of_sites(const cases::Material &material, const cases::Snapshot &snapshot)
  {
    const double of_solid = material.solid.volumetric_heat_capacity();
    const double of_liquid = material.liquid.volumetric_heat_capacity();
    const double of_melting = material.liquid.density * material.latent_heat;
    SiteHeat result;
    for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
    {
      // What merely holds a boundary value need not be finite.
      if(snapshot.weights[i] == 0)
        continue;
      const double solid = snapshot.solid_fraction[i], liquid = 1 - solid;
      const double sensible
          = snapshot.weights[i]
            * (material.curves
                   ? (solid * material.solid.density + liquid * material.liquid.density)
                         * sensible_heat(material, snapshot.temperature[i], solid)
                   : (solid * of_solid + liquid * of_liquid)
                         * (snapshot.temperature[i] - material.melting_temperature));
      const double latent = snapshot.weights[i] * liquid * of_melting;
      result.stored += sensible;
      result.latent += latent;
      result.magnitude += std::abs(sensible) + std::abs(latent);
    }
    return result;
  }

  double SiteHeat::difference(const cases::HeatBudget &book) const
  {
    return std::abs(stored - book.stored) + std::abs(latent - book.latent);
  }

  double SiteHeat::scale(const cases::HeatBudget &book) const
  {
    return std::max({magnitude, std::abs(book.stored) + std::abs(book.latent),
                     std::abs(book.initial)});
  }
} // namespace meltfront::verification
