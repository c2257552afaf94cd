#ifndef meltfront_reference_fem_enthalpy_curved_graph_h
#define meltfront_reference_fem_enthalpy_curved_graph_h

#include <cases/material.h>

#include <algorithm>
#include <memory>

namespace meltfront::reference_fem
{
  /**
   * The enthalpy graph H(u) of a material whose properties depend on temperature, or that
   * melts over a range of temperatures (cases::ThermalCurves), in Kirchhoff's variable
   * u = int k dT from the melting temperature, or the solidus (W/m). Takes the place of
   * EnthalpyGraph; H is per volume (J/m^3).
   *
   * @tparam latent the graph jumps at u = 0
   */
  template <bool latent>
  class CurvedGraph
  {
  public:
    static constexpr bool jumps = latent;
    static constexpr bool has_two_slopes = true;
    static constexpr bool linear = false;
    static constexpr bool curved = true;

    explicit CurvedGraph(const cases::Material &material)
      : curves(material.curves)
      , density(material.solid.density)
      , melting(material.melting_temperature)
      , molten(material.melting_range ? material.melting_range->liquidus : melting)
      , latent_warming(material.latent_heat
                       / std::min(material.solid.specific_heat_capacity,
                                  material.liquid.specific_heat_capacity))
    {
    }

    /** dH/du off the jump; the upper side's at u = 0. */
    double slope(double u) const
    {
      const cases::ThermalState state = curves->at_kirchhoff(u);
      return density * state.capacity / state.conductivity;
    }

    /** dH/dT (J/(m^3 K)), with the latent heat that a range spreads. */
    double capacity(double u) const
    {
      return density * curves->at_kirchhoff(u).capacity;
    }

    /** H(u); its upper end at u = 0. */
    double enthalpy(double u) const
    {
      return density * curves->at_kirchhoff(u).enthalpy;
    }

    /** As EnthalpyGraph::resolve. */
    double resolve(double heat, double volume, double stiffness,
                   double transfer = 0) const
    {
      return curves->resolve(heat, volume * density, stiffness, transfer).kirchhoff;
    }

    /** d(T - T_m)/du; the upper side's at u = 0. */
    double excess_slope(double u) const
    {
      return 1 / curves->at_kirchhoff(u).conductivity;
    }

    /** T - T_m (K) where Kirchhoff's variable is u. */
    double temperature_excess(double u) const
    {
      return curves->at_kirchhoff(u).temperature - melting;
    }

    /** T - T_m (K) where the enthalpy per volume is H. */
    double temperature_excess_at_enthalpy(double enthalpy) const
    {
      return curves->at_enthalpy(enthalpy / density).temperature - melting;
    }

    /** L/c (K): by how much the latent heat would warm. */
    double latent_temperature() const
    {
      return latent_warming;
    }

    /** u where T - T_m is given. */
    double kirchhoff(double temperature_excess) const
    {
      return curves->at_temperature(melting + temperature_excess).kirchhoff;
    }

    /** Solid, melting and liquid, where a range has all three, and the jump. */
    int region(double temperature_excess) const
    {
      return (temperature_excess > 0) - (temperature_excess < 0)
             + (temperature_excess > molten - melting);
    }

  private:
    std::shared_ptr<const cases::ThermalCurves> curves;
    double density, melting, molten, latent_warming;
  };
} // namespace meltfront::reference_fem

#endif
