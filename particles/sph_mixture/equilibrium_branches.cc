#include <cases/numbers.h>
#include <particles/sph_mixture/equilibrium_branches.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    using cases::infinity;

    /** How far beyond a kink, over the latent heat, a particle is put. */
    constexpr double beyond_kink = 1e-13;

    /** Liquid that is left just above the eutectic temperature. */
    double eutectic_liquid(const AlloySubstance &substance, double first, double second)
    {
      const cases::PhaseDiagram &diagram = substance.diagram;
      if(diagram.straight())
        return -diagram.depression(first, second) / substance.eutectic_excess;
      const double above = std::nextafter(substance.alloy.eutectic_temperature,
                                          substance.material.melting_temperature);
      return 1 - diagram.solid_fraction(above, first, second);
    }

    /** dP/dc of the liquidus at a concentration, by central differences. */
    double liquidus_slope(const AlloySubstance &substance, double concentration)
    {
      const double largest = substance.alloy.solutes[0].largest_concentration;
      const double step = 1e-5 * largest;
      const double lower = std::max(concentration - step, 0.);
      const double upper = std::min(concentration + step, largest);
      return (substance.diagram.depression(upper) - substance.diagram.depression(lower))
             / (upper - lower);
    }

    /** A little above the enthalpy at which a mush without a eutectic reaches the end of
     * its liquidus. */
    double end_of_liquidus(const AlloySubstance &substance, double concentration)
    {
      if(substance.diagram.straight())
        return -infinity;
      const double largest = substance.alloy.solutes[0].largest_concentration;
      const double excess = -substance.diagram.depression(largest);
      const double liquid = concentration / largest;
      const double latent_heat = substance.material.latent_heat;
      return (1 - liquid) * substance.material.solid.specific_heat_capacity * excess
             + liquid
                   * (substance.material.liquid.specific_heat_capacity * excess
                      + latent_heat)
             + 1e-9 * latent_heat;
    }
  } // namespace

  EquilibriumBranches find_branches(const AlloySubstance &substance, double first,
                                    double second)
  {
    const double latent_heat = substance.material.latent_heat;
    const double solid_capacity = substance.material.solid.specific_heat_capacity;
    const double liquid_capacity = substance.material.liquid.specific_heat_capacity;
    const double depression = substance.diagram.depression(first, second);
    const double lowest = substance.eutectic_excess;
    const double liquid = latent_heat + liquid_capacity * std::max(-depression, lowest);
    if(depression <= 0)
      return {0, liquid, liquid, liquid, -infinity};
    const double knee = -depression * (liquid_capacity - solid_capacity);
    if(!std::isfinite(lowest))
      return {-infinity, -infinity, liquid, std::min(knee, liquid),
              end_of_liquidus(substance, first)};
    const double solid = solid_capacity * lowest;
    if(lowest >= -depression)
      return {solid, liquid, liquid, liquid, -infinity};
    const double left = eutectic_liquid(substance, first, second);
    const double eutectic
        = (1 - left) * solid + left * (liquid_capacity * lowest + latent_heat);
    return {solid, eutectic, liquid, std::clamp(knee, eutectic, liquid), -infinity};
  }

  EquilibriumSlopes find_slopes(const AlloySubstance &substance,
                                const EquilibriumBranches &branches, double enthalpy,
                                double excess, double liquid, double concentration)
  {
    const double solid_capacity = substance.material.solid.specific_heat_capacity;
    const double liquid_capacity = substance.material.liquid.specific_heat_capacity;
    const double heat_of_freezing
        = substance.material.latent_heat + (liquid_capacity - solid_capacity) * excess;
    if(enthalpy >= branches.liquid)
      return {1 / liquid_capacity, 0};
    if(enthalpy < branches.solid)
      return {1 / solid_capacity, 0};
    if(enthalpy <= branches.eutectic || !(excess < 0) || !(liquid > 0))
      return {0, 1 / heat_of_freezing};
    const double fraction_slope
        = substance.diagram.straight()
              ? liquid / -excess
              : liquid * liquid
                    / (concentration * liquidus_slope(substance, concentration / liquid));
    const double capacity = (1 - liquid) * solid_capacity + liquid * liquid_capacity
                            + heat_of_freezing * fraction_slope;
    return {1 / capacity, fraction_slope / capacity};
  }

  double stop_at_kink(const EquilibriumBranches &branches, double from, double to,
                      double latent_heat)
  {
    const double beyond = beyond_kink * latent_heat;
    const double kinks[]
        = {branches.solid, branches.eutectic, branches.knee, branches.liquid};
    if(to > from)
    {
      for(const double kink : kinks)
        if(from < kink && to > kink + beyond)
          return kink + beyond;
      return to;
    }
    for(int i = 3; i >= 0; --i)
      if(from > kinks[i] && to < kinks[i] - beyond)
        return std::max(kinks[i] - beyond, branches.known);
    return std::max(to, branches.known);
  }
} // namespace meltfront::particles
