#ifndef meltfront_particles_alloy_phase_exchange_h
#define meltfront_particles_alloy_phase_exchange_h

#include <particles/alloy/dual_number.h>
#include <particles/alloy/substance.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meltfront::particles
{
  /** What a solution at its liquidus does when it loses heat. */
  template <typename Number>
  struct Freezing
  {
    Number drop;     ///< of the temperature (K)
    Number fraction; ///< of its mass that becomes ice
  };

  /**
   * Ice that a solution makes at its liquidus, which its composition lowers by P, when it
   * loses the heat q per mass (J/kg). The drop d obeys
   *
   *   phi = d/(P + d),  q = phi L + phi c_s d + (1 - phi) c_l d
   *   =>  c_s d^2 + (L + P c_l - q) d - q P = 0
   *
   * (Monaghan, Huppert and Worster 2005, equations 4.4 and 4.9; the root without
   * cancellation). L is the latent heat at the temperature before the drop.
   */
  template <typename Number>
  Freezing<Number> freeze(const Number &heat, const Number &depression,
                          const Number &latent_heat, double solid_capacity,
                          double liquid_capacity)
  {
    using std::sqrt;
    const Number product = heat * depression;
    const Number b = latent_heat + depression * liquid_capacity - heat;
    const Number root = sqrt(b * b + 4 * solid_capacity * product);
    const Number drop
        = value_of(b) > 0 ? 2 * product / (b + root) : (root - b) / (2 * solid_capacity);
    return {drop, drop / (depression + drop)};
  }

  /** The liquid and the ice of a site. */
  template <typename Number>
  struct SiteContent
  {
    Number liquid_mass, liquid_heat, ice_mass, ice_heat;
  };

  /**
   * The change of phase between the liquid and the ice of one site, after their heats or
   * the solute have changed; masses in kg m^(d-3), heats in J m^(d-3), PS is the
   * depression of the liquidus times mass.
   *
   * * Liquid below its liquidus freezes: freeze().
   * * Liquid above its liquidus melts ice. With its heat E and the ice's enthalpy per
   *   mass e
   *
   *     E + delta e = (m + delta)(c_l x + L),  x = -PS/(m + delta),
   *     m + delta = (E - m e + c_l PS)/(L - e).
   *
   * * Where a site as a whole is at the eutectic temperature or colder, both phases are
   *   in equilibrium with each other (cases::PhaseDiagram): the rest of the liquid
   *   freezes at that temperature with its latent heat, its solute stays in the solid,
   *   and melting gives it back.
   * * So they are where crystals leave the liquid less than half of the volume that its
   *   mass would take: hardly any surface is left through which it could exchange heat
   *   with other sites.
   */
  class SiteExchange
  {
  public:
    /** @param constant_latent_heat as published: no function of the state.
     * @param equilibrium keep the last two rules. */
    SiteExchange(const AlloySubstance &substance, double site_mass,
                 bool constant_latent_heat, bool equilibrium);

    /** Ice that leaves the liquid. */
    template <typename Number>
    struct NewIce
    {
      Number mass, heat;
    };

    /** Whether liquid is below its liquidus. */
    template <typename Number>
    bool freezes(const SiteContent<Number> &site, double depression_mass) const
    {
      return value_of(site.liquid_heat)
             < latent_heat * value_of(site.liquid_mass) - c_l * depression_mass;
    }

    /** Take from the liquid what freezes. */
    template <typename Number>
    NewIce<Number> freeze_liquid(SiteContent<Number> &site, double depression_mass) const
    {
      const Number mass = site.liquid_mass;
      const Number lowered = depression_mass / mass;
      const Number deficit = latent_heat - c_l * lowered - site.liquid_heat / mass;
      const Number released
          = latent_heat - (constant_latent_heat ? 0. : c_l - c_s) * lowered;
      const Freezing<Number> made = freeze(deficit, lowered, released, c_s, c_l);
      const Number x = -(lowered + made.drop);
      const NewIce<Number> ice{made.fraction * mass, made.fraction * mass * c_s * x};
      site.liquid_mass -= ice.mass;
      if(constant_latent_heat)
        site.liquid_heat = site.liquid_mass * (c_l * x + latent_heat);
      else
        site.liquid_heat -= ice.heat;
      return ice;
    }

    /** Melt ice if the liquid is above its liquidus. */
    template <typename Number>
    void melt_ice(SiteContent<Number> &site, double depression_mass) const
    {
      const Number own = site.ice_heat / site.ice_mass;
      const Number after
          = (site.liquid_heat - site.liquid_mass * own + c_l * depression_mass)
            / (latent_heat - own);
      const Number melted = after - site.liquid_mass;
      if(!(value_of(melted) > 0))
        return;
      if(value_of(melted) >= value_of(site.ice_mass))
      {
        become_liquid(site);
        return;
      }
      const Number carried = melted * own;
      site.liquid_mass += melted;
      site.liquid_heat += carried;
      site.ice_mass -= melted;
      site.ice_heat -= carried;
    }

    /**
     * All rules, with new ice going to the ice of the site.
     * @return whether both phases are kept in equilibrium.
     */
    template <typename Number>
    bool settle(SiteContent<Number> &site, double depression_mass) const
    {
      if(!(value_of(site.ice_mass) > 0))
        become_liquid(site);
      if(equilibrium && value_of(site.ice_mass) > 0
         && equilibrate(site, depression_mass, !(value_of(site.liquid_mass) > 0)))
        return true;
      if(freezes(site, depression_mass))
      {
        const NewIce<Number> made = freeze_liquid(site, depression_mass);
        site.ice_mass += made.mass;
        site.ice_heat += made.heat;
      }
      else if(value_of(site.ice_mass) > 0)
        melt_ice(site, depression_mass);
      return equilibrium && value_of(liquid_excess(site)) < eutectic_excess
             && equilibrate(site, depression_mass, true);
    }

    /**
     * Rate at which the liquid freezes while it stays at its liquidus and takes up heat
     * at the rate F and PS at the rate J: with the enthalpy e per mass of what changes
     * phase, that of ice at the liquidus or, where ice melts, of the site's ice,
     *
     *   E = L m - c_l PS,  dE/dt = F + e dm/dt  =>  dm/dt = (F + c_l J)/(L - e).
     */
    NewIce<double> freezing_rate(const SiteContent<double> &site, double depression_mass,
                                 double heat_flow, double depression_flow) const
    {
      const double gain = heat_flow + c_l * depression_flow;
      const double enthalpy = gain > 0 ? site.ice_heat / site.ice_mass
                                       : -c_s * depression_mass / site.liquid_mass;
      const double rate = -gain / (latent_heat - enthalpy);
      return {rate, rate * enthalpy};
    }

    /**
     * Enthalpies of a site at which its temperature as a function of these has a kink,
     * ascending: where all has frozen and all eutectic solid has melted, if there is a
     * eutectic; where the last ice has melted.
     */
    std::array<double, 3> kinks(double depression_mass) const
    {
      const double liquidus = latent_heat * site_mass - c_l * depression_mass;
      if(!std::isfinite(eutectic_excess))
        return {liquidus, liquidus, liquidus};
      const double solid = c_s * eutectic_excess * site_mass;
      const double most = std::min(depression_mass / -eutectic_excess, site_mass);
      const double melted = solid + most * (latent_heat + (c_l - c_s) * eutectic_excess);
      return {solid, melted, std::max(liquidus, melted)};
    }

    /** T - T_m of the liquid. */
    template <typename Number>
    Number liquid_excess(const SiteContent<Number> &site) const
    {
      return (site.liquid_heat / site.liquid_mass - latent_heat) / c_l;
    }

    /** T - T_m of the ice. */
    template <typename Number>
    Number ice_excess(const SiteContent<Number> &site) const
    {
      return site.ice_heat / (c_s * site.ice_mass);
    }

    /** At the melting point of the pure solvent (J/kg). */
    double heat_of_melting() const
    {
      return latent_heat;
    }

    /** Whether both phases of a site in this state are kept in equilibrium. */
    bool is_kept(const cases::PhaseState &state) const
    {
      return state.temperature <= eutectic_temperature || state.liquid_fraction < crowded;
    }

  private:
    template <typename Number>
    static void become_liquid(SiteContent<Number> &site)
    {
      site.liquid_mass += site.ice_mass;
      site.liquid_heat += site.ice_heat;
      site.ice_mass = site.ice_heat = 0;
    }

    /** Put both phases into equilibrium if they are to be kept there, or by force.
     * @return whether that was done. */
    template <typename Number>
    bool equilibrate(SiteContent<Number> &site, double depression_mass, bool force) const
    {
      const Number heat = site.liquid_heat + site.ice_heat;
      const double lowered = depression_mass / site_mass;
      const cases::PhaseState state
          = diagram->on_straight(value_of(heat) / site_mass, lowered);
      if(!force && !is_kept(state))
        return false;
      const double at = state.temperature - melting_temperature;
      const double released = latent_heat + (c_l - c_s) * at; // per mass that freezes
      const double liquid = state.liquid_fraction;
      const bool fixed
          = liquid > 0 && (state.temperature <= eutectic_temperature || at == 0);
      const bool mush = !fixed && liquid > 0 && liquid < 1;
      const double capacity = (1 - liquid) * c_s + liquid * c_l
                              + (mush ? lowered / (at * at) * released : 0.);
      const Number x = follow_number(at, fixed ? 0. : 1 / (capacity * site_mass), heat);
      // By the lever rule, at the eutectic temperature by the heat.
      const double slope
          = fixed ? 1 / released : (mush ? lowered / (at * at * capacity) : 0.);
      site.liquid_mass = follow_number(liquid * site_mass, slope, heat);
      site.ice_mass = site_mass - site.liquid_mass;
      // The larger part has the rest: to a part of little mass it would be much.
      if(liquid < 0.5)
      {
        site.liquid_heat = site.liquid_mass * (c_l * x + latent_heat);
        site.ice_heat = heat - site.liquid_heat;
      }
      else
      {
        site.ice_heat = c_s * (site.ice_mass * x);
        site.liquid_heat = heat - site.ice_heat;
      }
      return true;
    }

    const cases::PhaseDiagram *diagram;
    double site_mass;
    double melting_temperature, latent_heat, c_s, c_l;
    double eutectic_temperature, eutectic_excess;
    double crowded; ///< liquid fraction below which crystals leave it too little room
    bool constant_latent_heat, equilibrium;
  };
} // namespace meltfront::particles

#endif
