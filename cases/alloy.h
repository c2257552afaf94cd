#ifndef meltfront_cases_alloy_h
#define meltfront_cases_alloy_h

#include <cases/material.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::cases
{
  /** A substance dissolved in the liquid, all of which the growing crystals reject. */
  struct Solute
  {
    std::string name;

    /** Fall of the liquidus per unit mass fraction of a straight liquidus (K), >= 0. */
    double liquidus_slope = 0;

    /**
     * Fall of the liquidus T_m - T_L(C) (K) at a mass fraction in the liquid, for a
     * liquidus that is not straight: zero at C = 0 and strictly rising up to
     * largest_concentration. Empty: liquidus_slope says all.
     */
    std::function<double(double concentration)> liquidus_curve{};
    double largest_concentration = 1; ///< up to which liquidus_curve is known

    double diffusivity = 0; ///< in the liquid (m^2/s)
    std::string liquidus{}; ///< as the case file gives it
  };

  /** A dilute alloy of a pure solvent (Material) with one or two solutes. */
  struct Alloy
  {
    std::vector<Solute> solutes;

    /** Temperature at which the rest of the liquid freezes; minus infinity for none. */
    double eutectic_temperature = -std::numeric_limits<double>::infinity();

    /**
     * Density of the crystals (kg/m^3), by which a mass fraction of solid becomes a
     * volume fraction, f_s rho / rho_crystal, wherever conductivities are mixed. The
     * motion that the difference would cause is not simulated. 0: that of the liquid.
     */
    double crystal_density = 0;
  };

  /** What a site in local equilibrium holds. */
  struct PhaseState
  {
    double temperature;
    double liquid_fraction; ///< by mass
  };

  /**
   * Local equilibrium of an alloy whose crystals are pure solvent.
   *
   * Specific enthalpy H (J/kg) is measured from the solid solvent at its melting
   * temperature T_m, as in Material, so that with theta = T - T_m and the liquid's mass
   * fraction f
   *
   *   H = (1 - f) c_s theta + f (c_l theta + L),
   *
   * which is an energy function: the heat of freezing at T is L + (c_l - c_s) theta.
   * All solute stays in the liquid, C_liquid = C/f, and f is below 1 only where
   * T = T_L(C_liquid): the lever rule. Where the liquidus would fall below the eutectic
   * temperature, the rest freezes at that temperature.
   */
  class PhaseDiagram
  {
  public:
    /** @throws InputError for a curved liquidus with two solutes, or for a negative
     * slope. */
    PhaseDiagram(const Material &material, const Alloy &alloy);

    /** Whether all liquidus surfaces are straight: depression() is then all that a
     * composition matters by. */
    bool straight() const
    {
      return !curve;
    }

    /** T_m - T_L of a liquid (K). */
    double depression(double first, double second = 0) const
    {
      return curve ? curve(first) : first_slope * first + second_slope * second;
    }

    /** Temperature at which a liquid of this composition begins to freeze. */
    double liquidus(double first, double second = 0) const;

    /** Temperature and liquid fraction of a site that holds an enthalpy (J/kg) and
     * solutes (mass fractions of all its mass). */
    PhaseState equilibrium(double enthalpy, double first, double second = 0) const
    {
      return curve ? on_curve(enthalpy, first)
                   : on_straight(enthalpy, first_slope * first + second_slope * second);
    }

    /**
     * The same for a straight liquidus, given the depression P of the site as if all of
     * it were liquid. In the mush
     *
     *   c_s theta^2 - b theta - P L = 0,  b = H + P (c_l - c_s)
     *
     * (after Monaghan, Huppert and Worster 2005, equations 4.4 and 4.9); the negative
     * root is taken in the form without cancellation.
     */
    PhaseState on_straight(double enthalpy, double depression) const
    {
      if(enthalpy >= latent_heat - liquid_capacity * depression)
        return above_liquidus(enthalpy);
      const double b = enthalpy + depression * (liquid_capacity - solid_capacity);
      const double product = depression * latent_heat;
      const double root = std::sqrt(b * b + 4 * solid_capacity * product);
      return below_liquidus(enthalpy, b > 0 ? -2 * product / (b + root)
                                            : (b - root) / (2 * solid_capacity));
    }

    /** H at a temperature in equilibrium (J/kg); at the eutectic temperature, or at the
     * melting point without solute, all solid. */
    double enthalpy(double temperature, double first, double second = 0) const;

    /** Mass fraction of solid at a temperature in equilibrium. */
    double solid_fraction(double temperature, double first, double second = 0) const;

    /** Volume fraction that a mass fraction of solid takes up; at most 1. */
    double volume_fraction(double solid_fraction) const
    {
      return std::min(solid_fraction * expansion, 1.);
    }

    /** k = theta k_s + (1 - theta) k_l, theta the solid's volume fraction (W/(m K)). */
    double conductivity(double solid_fraction) const
    {
      return liquid_conductivity
             + volume_fraction(solid_fraction)
                   * (solid_conductivity - liquid_conductivity);
    }

  private:
    PhaseState on_curve(double enthalpy, double concentration) const;

    PhaseState above_liquidus(double enthalpy) const
    {
      const double excess = (enthalpy - latent_heat) / liquid_capacity;
      return excess >= eutectic_excess ? PhaseState{melting_temperature + excess, 1.}
                                       : below_liquidus(enthalpy, excess);
    }

    /** Take eutectic and pure solid into account, and find the liquid fraction. */
    PhaseState below_liquidus(double enthalpy, double excess) const
    {
      excess = std::max(excess, std::min(eutectic_excess, enthalpy / solid_capacity));
      const double heat_of_melting
          = latent_heat + (liquid_capacity - solid_capacity) * excess;
      const double fraction = heat_of_melting > 0
                                  ? (enthalpy - solid_capacity * excess) / heat_of_melting
                                  : (excess < 0 ? 0. : 1.);
      return {melting_temperature + excess, std::clamp(fraction, 0., 1.)};
    }

    double melting_temperature, latent_heat, solid_capacity, liquid_capacity;
    double solid_conductivity, liquid_conductivity;
    double expansion;       ///< rho / rho_crystal
    double eutectic_excess; ///< T_E - T_m
    double first_slope = 0, second_slope = 0;
    std::function<double(double)> curve;
    double largest_concentration = 1;
  };

  /**
   * The monotone curve through the points (concentration, liquidus temperature) of a
   * table, as Solute::liquidus_curve (Fritsch and Butland's monotone cubic, from Boost).
   *
   * @throws InputError unless concentrations rise from 0, temperatures fall from T_m, and
   * there are at least four points.
   */
  std::function<double(double)>
  liquidus_through(const std::vector<std::pair<double, double>> &points,
                   double melting_temperature);
} // namespace meltfront::cases

#endif
