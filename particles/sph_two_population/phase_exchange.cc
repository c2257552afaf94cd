#include <particles/sph_two_population/phase_exchange.h>

namespace meltfront::particles
{
  SiteExchange::SiteExchange(const AlloySubstance &substance, double site_mass,
                             bool constant_latent_heat, bool equilibrium)
    : diagram(&substance.diagram)
    , site_mass(site_mass)
    , melting_temperature(substance.material.melting_temperature)
    , heats{substance.material.solid.specific_heat_capacity,
            substance.material.liquid.specific_heat_capacity,
            substance.material.latent_heat}
    , eutectic_temperature(melting_temperature + substance.eutectic_excess)
    , eutectic_excess(substance.eutectic_excess)
    // 1 - r (1 - f) < f/2, r the density over the crystals'.
    , crowded(substance.expansion > 1
                  ? (substance.expansion - 1) / (substance.expansion - 0.5)
                  : 0.)
    , constant_latent_heat(constant_latent_heat)
    , equilibrium(equilibrium
                  && (crowded > 0 || std::isfinite(substance.eutectic_excess)))
  {
  }

  double SiteExchange::largest_kept_enthalpy(const CurvedSolute &solute) const
  {
    // Enthalpy rises with the temperature and with the liquid fraction: no root is
    // needed.
    double largest = -std::numeric_limits<double>::infinity();
    if(crowded > 0)
    {
      const double x = -solute.depression(crowded * site_mass);
      largest = heats.c_s * x + crowded * released_at(x);
    }
    if(std::isfinite(eutectic_excess))
    {
      const double liquid = std::min(eutectic_liquid(solute) / site_mass, 1.);
      largest = std::max(largest, heats.c_s * eutectic_excess
                                      + liquid * released_at(eutectic_excess));
    }
    return largest;
  }

  std::optional<cases::PhaseState>
  SiteExchange::kept_state(double enthalpy, const CurvedSolute &solute, bool force) const
  {
    if(!force && !(enthalpy <= largest_kept_enthalpy(solute)))
      return std::nullopt;
    const double lowered = solute.depression(site_mass);
    const double missing = heats.latent_heat - heats.c_l * lowered - enthalpy;
    double excess = (enthalpy - heats.latent_heat) / heats.c_l;
    if(missing > 0)
      excess = -lowered
               - solute.freeze(missing, lowered, site_mass, released_at(-lowered), heats)
                     .drop;
    else if(excess >= eutectic_excess)
      return cases::PhaseState{melting_temperature + excess, 1.};
    excess = std::max(excess, std::min(eutectic_excess, enthalpy / heats.c_s));
    const double liquid = (enthalpy - heats.c_s * excess) / released_at(excess);
    return cases::PhaseState{melting_temperature + excess, std::clamp(liquid, 0., 1.)};
  }
} // namespace meltfront::particles
