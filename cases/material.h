#ifndef meltfront_cases_material_h
#define meltfront_cases_material_h

#include <cases/property_curve.h>
#include <cases/thermal_curves.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace meltfront::cases
{
  /** Thermal properties of one phase. Those that vary with temperature have a curve, and
   * their numbers are the values at the melting temperature. */
  struct PhaseProperties
  {
    double conductivity = 1;           ///< W/(m K)
    double specific_heat_capacity = 1; ///< J/(kg K)
    double density = 1;                ///< kg/m^3
    std::shared_ptr<const PropertyCurve>
        conductivity_curve{}; ///< W/(m K); null: constant
    std::shared_ptr<const PropertyCurve>
        heat_capacity_curve{}; ///< J/(kg K); null: constant

    /** W/(m K) */
    double conductivity_at(double temperature) const
    {
      return conductivity_curve ? (*conductivity_curve)(temperature) : conductivity;
    }

    /** Per mass, J/(kg K). */
    double heat_capacity_at(double temperature) const
    {
      return heat_capacity_curve ? (*heat_capacity_curve)(temperature)
                                 : specific_heat_capacity;
    }

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

  /** Temperatures between which a substance is partly solid. */
  struct MeltingRange
  {
    double solidus, liquidus; ///< K or degrees Celsius, as the scene's
    /** Between them: falls from 1 or less at the solidus, where the rest freezes, to
     * 0 at the liquidus. */
    std::shared_ptr<const PropertyCurve> solid_fraction;
    std::string words; ///< `linear`, `lever`, `Scheil` or what a user gave
  };

  /**
   * A pure substance, with a sharp melting temperature or a range of melting.
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
    /** Null: it melts at the melting temperature; else that is the solidus. */
    std::shared_ptr<const MeltingRange> melting_range{};
    /** Of a material that varies_with_temperature() or has a melting range, else null:
     * set by update_curves(). */
    std::shared_ptr<const ThermalCurves> curves{};

    /** Whether a phase's conductivity or heat capacity depends on temperature. */
    bool varies_with_temperature() const;

    /** The temperatures between which all properties are known: those of the curves'
     * first and last points (K); infinite where none limits them. */
    std::pair<double, double> known_temperatures() const;

    /** Make `curves` anew of the properties. @throws InputError as ThermalCurves */
    void update_curves();

    /** T(H), inverse of the enthalpy graph. */
    double temperature(double enthalpy) const
    {
      if(curves)
        return curves->at_enthalpy(enthalpy).temperature;
      return melting_temperature + std::min(enthalpy, 0.) / solid.specific_heat_capacity
             + std::max(enthalpy - latent_heat, 0.) / liquid.specific_heat_capacity;
    }

    /** H(T) of a point that holds the given mass fraction of solid when T is the melting
     * point. */
    double enthalpy(double temperature, double solid_fraction_at_melting = 0) const
    {
      if(curves)
        return temperature == melting_temperature
                   ? curves->jump() * (1 - solid_fraction_at_melting)
                   : curves->at_temperature(temperature).enthalpy;
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
      if(curves)
        return curves->at_enthalpy(enthalpy).solid_fraction;
      if(latent_heat == 0)
        return enthalpy < 0 ? 1. : 0.;
      return std::clamp(1 - enthalpy / latent_heat, 0., 1.);
    }
  };
} // namespace meltfront::cases

#endif
