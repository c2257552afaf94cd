#ifndef meltfront_reference_fem_enthalpy_graph_h
#define meltfront_reference_fem_enthalpy_graph_h

#include <cases/material.h>

#include <algorithm>

namespace meltfront::reference_fem
{
  /**
   * The enthalpy graph in Kirchhoff's variable u = k_phase (T - T_m) (W/m):
   *
   *   H(u) = C_s u / k_s                (u < 0, solid)
   *   H(0) = [0, rho L]                 (at the melting temperature)
   *   H(u) = rho L + C_l u / k_l        (u > 0, liquid)
   *
   * with H the enthalpy per volume (J/m^3) counted from the solid at the melting
   * temperature and C = rho c. There is no mushy width: the jump is kept exactly.
   *
   * The two parameters compose the graph from the effects that a scene calls for.
   * @tparam latent the graph jumps at u = 0 (phase_change)
   * @tparam two_slopes the phases store or conduct differently (phase_conductivity,
   * phase_heat_capacity)
   */
  template <bool latent, bool two_slopes>
  class EnthalpyGraph
  {
  public:
    static constexpr bool jumps = latent;
    static constexpr bool has_two_slopes = two_slopes;
    static constexpr bool linear = !latent && !two_slopes;
    static constexpr bool curved = false; ///< CurvedGraph

    explicit EnthalpyGraph(const cases::Material &material)
      : solid_conductivity(material.solid.conductivity)
      , liquid_conductivity(material.liquid.conductivity)
      , solid_capacity(material.solid.volumetric_heat_capacity())
      , liquid_capacity(material.liquid.volumetric_heat_capacity())
      , volumetric_latent_heat(material.solid.density * material.latent_heat)
    {
    }

    /** dH/du off the jump; the liquid's at u = 0. */
    double slope(double u) const
    {
      if constexpr(two_slopes)
        if(u >= 0)
          return liquid_capacity / liquid_conductivity;
      return solid_capacity / solid_conductivity;
    }

    /** rho c of the phase (J/(m^3 K)); the liquid's at u = 0. */
    double capacity(double u) const
    {
      if constexpr(two_slopes)
        if(u >= 0)
          return liquid_capacity;
      return solid_capacity;
    }

    /** H(u); its upper end, rho L, at u = 0. */
    double enthalpy(double u) const
    {
      if constexpr(latent)
        if(u >= 0)
          return volumetric_latent_heat + slope(u) * u;
      return slope(u) * u;
    }

    /** volume H(u); at the jump the heat in it that is nearest to the one given. */
    double heat_on_graph(double u, double volume, double heat) const
    {
      if(latent && u == 0)
        return std::clamp(heat, 0., volume * volumetric_latent_heat);
      return volume * enthalpy(u);
    }

    /** The root u of the inclusion volume H(u) + transfer (T - T_m) + stiffness u = heat,
     * all factors >= 0. */
    double resolve(double heat, double volume, double stiffness,
                   double transfer = 0) const
    {
      if(heat < 0)
        return heat / (volume * slope(-1) + stiffness + transfer * excess_slope(-1));
      if constexpr(latent)
      {
        heat -= volume * volumetric_latent_heat;
        if(heat <= 0)
          return 0;
      }
      return heat / (volume * slope(1) + stiffness + transfer * excess_slope(1));
    }

    /** d(T - T_m)/du; the liquid's at u = 0. */
    double excess_slope(double u) const
    {
      if constexpr(two_slopes)
        if(u >= 0)
          return 1 / liquid_conductivity;
      return 1 / solid_conductivity;
    }

    /** T - T_m (K) where Kirchhoff's variable is u. */
    double temperature_excess(double u) const
    {
      if constexpr(two_slopes)
        if(u > 0)
          return u / liquid_conductivity;
      return u / solid_conductivity;
    }

    /** T - T_m (K) where the enthalpy per volume is H. */
    double temperature_excess_at_enthalpy(double enthalpy) const
    {
      if(enthalpy < 0)
        return enthalpy / solid_capacity;
      if constexpr(latent)
      {
        enthalpy -= volumetric_latent_heat;
        if(enthalpy <= 0)
          return 0;
      }
      if constexpr(two_slopes)
        return enthalpy / liquid_capacity;
      return enthalpy / solid_capacity;
    }

    /** L/c (K), with the smaller c: by how much the latent heat would warm. */
    double latent_temperature() const
    {
      return volumetric_latent_heat / std::min(solid_capacity, liquid_capacity);
    }

    /** u where T - T_m is given. */
    double kirchhoff(double temperature_excess) const
    {
      if constexpr(two_slopes)
        if(temperature_excess > 0)
          return liquid_conductivity * temperature_excess;
      return solid_conductivity * temperature_excess;
    }

  private:
    double solid_conductivity, liquid_conductivity;
    double solid_capacity, liquid_capacity;
    double volumetric_latent_heat;
  };
} // namespace meltfront::reference_fem

#endif
