#ifndef meltfront_reference_fem_enthalpy_mush_graph_h
#define meltfront_reference_fem_enthalpy_mush_graph_h

#include <cases/alloy.h>
#include <cases/material.h>
#include <reference_fem/enthalpy/liquidus.h>

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
   * The enthalpy graph of an alloy in t = T - T_m (K), for a node whose solute X would
   * lower the melting temperature by P if all of it were liquid:
   *
   *   H(t) = C_s t                                       (t < t_E, solid)
   *   H(t_E) = [C_s t_E, C_s t_E + f_E (rho L + (C_l - C_s) t_E)]
   *   H(t) = C_s t + f (rho L + (C_l - C_s) t), f = X/y  (t_E < t < -P, mush)
   *   H(t) = rho L + C_l t                               (t > -P, liquid)
   *
   * with H the enthalpy per volume (J/m^3), C = rho c, y(-t) the solute of liquid whose
   * liquidus is at t (see Liquidus; X/y = -P/t where that is straight), t_E the eutectic
   * temperature less T_m and f_E = min(1, X/y(-t_E)) (the lever rule, see
   * cases::PhaseDiagram). H rises strictly with t; its slope in the mush is
   *
   *   C_s + f (C_l - C_s) + f (rho L + (C_l - C_s) t)/(y dd/dy),
   *
   * d(y) the liquidus' depression (C_s + rho L P/t^2 of a straight one), and it has kinks
   * at the liquidus and on the jump. A node without solute jumps by rho L at t = 0
   * instead.
   */
  class MushGraph
  {
  public:
    MushGraph(const cases::Material &material, const cases::Alloy &alloy)
      : diagram(excess_diagram(material, alloy))
      , line(alloy)
      , density(material.solid.density)
      , solid_capacity(material.solid.volumetric_heat_capacity())
      , liquid_capacity(material.liquid.volumetric_heat_capacity())
      , latent_heat(material.solid.density * material.latent_heat)
      , eutectic(alloy.eutectic_temperature - material.melting_temperature)
      , eutectic_solute(std::isfinite(eutectic) ? line.solute_at(-eutectic) : -eutectic)
    {
    }

    /** What an amount of solute, in the unit of the liquidus, makes of a node. */
    Composition composition(double solute) const
    {
      return {solute, line.depression(solute)};
    }

    /** Whether all liquidus surfaces are straight. */
    bool straight() const
    {
      return line.straight();
    }

    /** Whether equilibrium is known at t. */
    bool known(double excess, const Composition &node) const
    {
      return node.solute <= 0 || excess <= eutectic
             || -excess <= line.largest_depression();
    }

    /** t above which all is liquid. */
    double liquidus(const Composition &node) const
    {
      return std::max(-node.depression, eutectic);
    }

    /** t at which the graph jumps; minus infinity where it does not. */
    double jump(const Composition &node) const
    {
      return node.depression > 0 ? eutectic : 0;
    }

    MushRegion region(double excess, const Composition &node) const
    {
      const double step = jump(node);
      if(excess <= step)
        return excess < step ? MushRegion::solid : MushRegion::held;
      return excess < liquidus(node) ? MushRegion::mush : MushRegion::liquid;
    }

    /** H(t), its upper end on the jump. */
    double enthalpy(double excess, const Composition &node) const
    {
      if(excess >= liquidus(node))
        return latent_heat + liquid_capacity * excess;
      if(excess < jump(node))
        return lower_enthalpy(excess);
      return lower_enthalpy(excess) + liquid_fraction(excess, node) * melting(excess);
    }

    /** H of solid at t: the lower end on the jump. */
    double lower_enthalpy(double excess) const
    {
      return solid_capacity * excess;
    }

    /** dH/dt off the jump; the liquid's at the liquidus. */
    double slope(double excess, const Composition &node) const
    {
      switch(region(excess, node))
      {
      case MushRegion::liquid:
        return liquid_capacity;
      case MushRegion::mush:
        return straight()
                   ? solid_capacity + latent_heat * node.depression / (excess * excess)
                   : curved_slope(excess, node);
      default:
        return solid_capacity;
      }
    }

    /** The root t of the inclusion volume H(t) + stiffness t = heat. */
    double resolve(double heat, double volume, double stiffness,
                   const Composition &node) const
    {
      const double top = liquidus(node), step = jump(node);
      const auto load = [&](double enthalpy, double excess)
      { return volume * enthalpy + stiffness * excess; };
      if(heat >= load(latent_heat + liquid_capacity * top, top))
        return (heat - volume * latent_heat) / (volume * liquid_capacity + stiffness);
      const double a = volume * solid_capacity + stiffness;
      if(std::isfinite(step) && heat <= load(enthalpy(step, node), step))
        return std::min(heat / a, step);
      if(!straight())
        return resolve_on_curve(heat, volume, a, node);
      const double b
          = heat + volume * node.depression * (liquid_capacity - solid_capacity);
      const double product = volume * node.depression * latent_heat;
      const double root = std::sqrt(b * b + 4 * a * product);
      return b > 0 ? -2 * product / (b + root) : (b - root) / (2 * a);
    }

    /** t where the enthalpy per volume is H. */
    double excess_at_enthalpy(double enthalpy, const Composition &node) const
    {
      return state(enthalpy, node).temperature;
    }

    /** t, as the state's temperature, and liquid fraction where the enthalpy per volume
     * is H. */
    cases::PhaseState state(double enthalpy, const Composition &node) const
    {
      if(straight())
        return diagram.on_straight(enthalpy / density, node.depression);
      const double excess = resolve(enthalpy, 1, 0, node), heat = melting(excess);
      if(region(excess, node) == MushRegion::liquid)
        return {excess, 1};
      const double liquid = heat > 0 ? (enthalpy - lower_enthalpy(excess)) / heat
                                     : (excess < 0 ? 0. : 1.);
      return {excess, std::clamp(liquid, 0., 1.)};
    }

    /** f_E: what is liquid, by mass, when the eutectic temperature is reached. */
    double eutectic_liquid_fraction(const Composition &node) const
    {
      return node.solute < eutectic_solute ? node.solute / eutectic_solute : 1;
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

    double liquid_fraction(double excess, const Composition &node) const
    {
      return excess == eutectic ? eutectic_liquid_fraction(node)
                                : std::min(node.solute / line.solute_at(-excess), 1.);
    }

    double curved_slope(double excess, const Composition &node) const
    {
      const double solute = line.solute_at(-excess), liquid = node.solute / solute;
      return solid_capacity + liquid * (liquid_capacity - solid_capacity)
             + liquid * melting(excess) / (solute * line.slope(solute));
    }

    /** The root in the mush, found as the solute of its liquid: the curve need not be
     * inverted. @param falling slope of the load without latent heat */
    double resolve_on_curve(double heat, double volume, double falling,
                            const Composition &node) const
    {
      const auto missing = [&](double solute, double depression)
      {
        return heat + falling * depression
               - volume * (node.solute / solute) * melting(-depression);
      };
      return -line.depression(line.find(missing, node.solute));
    }

    cases::PhaseDiagram diagram;
    Liquidus line;
    double density, solid_capacity, liquid_capacity;
    double latent_heat;     ///< rho L (J/m^3)
    double eutectic;        ///< T_E - T_m (K)
    double eutectic_solute; ///< y(-t_E)
  };
} // namespace meltfront::reference_fem

#endif
