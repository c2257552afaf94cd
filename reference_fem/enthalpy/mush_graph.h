#ifndef meltfront_reference_fem_enthalpy_mush_graph_h
#define meltfront_reference_fem_enthalpy_mush_graph_h

#include <cases/alloy.h>
#include <cases/material.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  /** Where on its enthalpy graph a node of an alloy is. */
  enum class MushRegion
  {
    solid,
    held, ///< on the jump
    mush,
    liquid
  };

  /**
   * The enthalpy graph of an alloy with straight liquidus in t = T - T_m (K), for a node
   * whose solutes would lower the melting temperature by P if all of it were liquid:
   *
   *   H(t) = C_s t                                       (t < t_E, solid)
   *   H(t_E) = [C_s t_E, C_s t_E + f_E (rho L + (C_l - C_s) t_E)]
   *   H(t) = C_s t + f (rho L + (C_l - C_s) t), f = -P/t (t_E < t < -P, mush)
   *   H(t) = rho L + C_l t                               (t > -P, liquid)
   *
   * with H the enthalpy per volume (J/m^3), C = rho c, t_E the eutectic temperature less
   * T_m and f_E = min(1, P/|t_E|) (the lever rule, see cases::PhaseDiagram). H rises
   * strictly with t; its slope in the mush is C_s + rho L P/t^2, and it has kinks at the
   * liquidus and on the jump. A node without solute jumps by rho L at t = 0 instead.
   */
  class MushGraph
  {
  public:
    MushGraph(const cases::Material &material, const cases::Alloy &alloy)
      : diagram(excess_diagram(material, alloy))
      , density(material.solid.density)
      , solid_capacity(material.solid.volumetric_heat_capacity())
      , liquid_capacity(material.liquid.volumetric_heat_capacity())
      , latent_heat(material.solid.density * material.latent_heat)
      , eutectic(alloy.eutectic_temperature - material.melting_temperature)
    {
    }

    /** t above which all is liquid. */
    double liquidus(double depression) const
    {
      return std::max(-depression, eutectic);
    }

    /** t at which the graph jumps; minus infinity where it does not. */
    double jump(double depression) const
    {
      return depression > 0 ? eutectic : 0;
    }

    MushRegion region(double excess, double depression) const
    {
      const double step = jump(depression);
      if(excess <= step)
        return excess < step ? MushRegion::solid : MushRegion::held;
      return excess < liquidus(depression) ? MushRegion::mush : MushRegion::liquid;
    }

    /** H(t), its upper end on the jump. */
    double enthalpy(double excess, double depression) const
    {
      if(excess >= liquidus(depression))
        return latent_heat + liquid_capacity * excess;
      if(excess < jump(depression))
        return lower_enthalpy(excess);
      return lower_enthalpy(excess)
             + liquid_fraction(excess, depression) * melting(excess);
    }

    /** H of solid at t: the lower end on the jump. */
    double lower_enthalpy(double excess) const
    {
      return solid_capacity * excess;
    }

    /** dH/dt off the jump; the liquid's at the liquidus. */
    double slope(double excess, double depression) const
    {
      switch(region(excess, depression))
      {
      case MushRegion::liquid:
        return liquid_capacity;
      case MushRegion::mush:
        return solid_capacity + latent_heat * depression / (excess * excess);
      default:
        return solid_capacity;
      }
    }

    /** The root t of the inclusion volume H(t) + stiffness t = heat. */
    double resolve(double heat, double volume, double stiffness, double depression) const
    {
      const double top = liquidus(depression), step = jump(depression);
      const auto load = [&](double enthalpy, double excess)
      { return volume * enthalpy + stiffness * excess; };
      if(heat >= load(latent_heat + liquid_capacity * top, top))
        return (heat - volume * latent_heat) / (volume * liquid_capacity + stiffness);
      const double a = volume * solid_capacity + stiffness;
      if(!std::isfinite(step) || heat > load(enthalpy(step, depression), step))
      {
        const double b = heat + volume * depression * (liquid_capacity - solid_capacity);
        const double product = volume * depression * latent_heat;
        const double root = std::sqrt(b * b + 4 * a * product);
        return b > 0 ? -2 * product / (b + root) : (b - root) / (2 * a);
      }
      return std::min(heat / a, step);
    }

    /** t where the enthalpy per volume is H. */
    double excess_at_enthalpy(double enthalpy, double depression) const
    {
      return state(enthalpy, depression).temperature;
    }

    /** t, as the state's temperature, and liquid fraction where the enthalpy per volume
     * is H. */
    cases::PhaseState state(double enthalpy, double depression) const
    {
      return diagram.on_straight(enthalpy / density, depression);
    }

    /** f_E: what is liquid, by mass, when the eutectic temperature is reached. */
    double eutectic_liquid_fraction(double depression) const
    {
      return depression < -eutectic ? depression / -eutectic : 1;
    }

    /** L/c (K), with the smaller c: by how much the latent heat would warm. */
    double latent_temperature() const
    {
      return latent_heat / std::min(solid_capacity, liquid_capacity);
    }

  private:
    /** The phase diagram in T - T_m, which then is not rounded to the digits of T. */
    static cases::PhaseDiagram excess_diagram(cases::Material material,
                                              cases::Alloy alloy)
    {
      alloy.eutectic_temperature -= material.melting_temperature;
      material.melting_temperature = 0;
      return {material, alloy};
    }

    /** Heat per volume that melts solid at t. */
    double melting(double excess) const
    {
      return latent_heat + (liquid_capacity - solid_capacity) * excess;
    }

    double liquid_fraction(double excess, double depression) const
    {
      return std::min(depression / -excess, 1.);
    }

    cases::PhaseDiagram diagram;
    double density, solid_capacity, liquid_capacity;
    double latent_heat; ///< rho L (J/m^3)
    double eutectic;    ///< T_E - T_m (K)
  };
} // namespace meltfront::reference_fem

#endif
