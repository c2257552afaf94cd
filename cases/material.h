#ifndef meltfront_cases_material_h
#define meltfront_cases_material_h

#include <algorithm>

namespace meltfront::cases
{
  /** Thermal properties of one phase, constant within the phase. */
  struct PhaseProperties
  {
    double conductivity = 1;           ///< W/(m K)
    double specific_heat_capacity = 1; ///< J/(kg K)
    double density = 1;                ///< kg/m^3

    /** J/(m^3 K) */
    double volumetric_heat_capacity() const
    {
      return density * specific_heat_capacity;
    }

    /** Thermal diffusivity k/(rho c), m^2/s. */
    double diffusivity() const
    {
      return conductivity / volumetric_heat_capacity();
    }
  };

  /**
   * A pure substance with a sharp melting temperature.
   *
   * Specific enthalpy H (J/kg) is measured from the solid at the melting temperature: H <
   * 0 solid, 0 <= H <= L at the melting temperature with solid fraction 1 - H/L, H > L
   * liquid.
   */
  struct Material
  {
    PhaseProperties solid;
    PhaseProperties liquid;
    double latent_heat = 1; ///< J/kg
    double melting_temperature
        = 0; ///< K or degrees Celsius, as the scene's other temperatures
    /** Gamma of Gibbs and Thomson (K m): where the solid's surface has the curvature
     * kappa (sum of the principal ones, 1/m, positive where solid is convex) it melts at
     * the melting temperature less Gamma kappa. */
    double gibbs_thomson_coefficient = 0;

    /** T(H), inverse of the enthalpy graph. */
    double temperature(double enthalpy) const
    {
      return melting_temperature + std::min(enthalpy, 0.) / solid.specific_heat_capacity
             + std::max(enthalpy - latent_heat, 0.) / liquid.specific_heat_capacity;
    }

    /** H(T) of a point that holds the given mass fraction of solid when T is the melting
     * point. */
    double enthalpy(double temperature, double solid_fraction_at_melting = 0) const
    {
      const double excess = temperature - melting_temperature;
      if(excess < 0)
        return solid.specific_heat_capacity * excess;
      if(excess > 0)
        return latent_heat + liquid.specific_heat_capacity * excess;
      return latent_heat * (1 - solid_fraction_at_melting);
    }

    /** clamp(1 - H/L, 0, 1), the mass fraction of solid; without latent heat a step at H
     * = 0. */
    double solid_fraction(double enthalpy) const
    {
      if(latent_heat == 0)
        return enthalpy < 0 ? 1. : 0.;
      return std::clamp(1 - enthalpy / latent_heat, 0., 1.);
    }
  };
} // namespace meltfront::cases

#endif
