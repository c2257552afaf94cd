#ifndef meltfront_particles_sph_two_population_phase_exchange_h
#define meltfront_particles_sph_two_population_phase_exchange_h

#include <particles/alloy/substance.h>
#include <particles/sph_two_population/site_liquidus.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace meltfront::particles
{
  /**
   * The change of phase between the liquid and the ice of one site, after their heats or
   * the solute have changed; masses in kg m^(d-3), heats in J m^(d-3). What the
   * site has dissolved is a StraightSolute, PS the depression of the liquidus times mass,
   * or a CurvedSolute.
   *
   * * Liquid below its liquidus freezes: freeze().
   * * Liquid above its liquidus melts ice. With its heat E and the ice's enthalpy per
   *   mass e
   *
   *     E + delta e = (m + delta)(c_l x + L),  x = -PS/(m + delta),
   *     m + delta = (E - m e + c_l PS)/(L - e).
   *
   *   On a curve PS = m P(S/m) follows the mass: CurvedSolute finds it.
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
    template <typename Number, typename Solute>
    bool freezes(const SiteContent<Number> &site, const Solute &solute) const
    {
      const double mass = value_of(site.liquid_mass);
      return value_of(site.liquid_heat)
             < heats.latent_heat * mass - heats.c_l * solute.depressed_mass(mass);
    }

    /** Take from the liquid what freezes. */
    template <typename Number, typename Solute>
    NewIce<Number> freeze_liquid(SiteContent<Number> &site, const Solute &solute) const
    {
      const Number mass = site.liquid_mass;
      const Number lowered = solute.depression(mass);
      const Number deficit
          = heats.latent_heat - heats.c_l * lowered - site.liquid_heat / mass;
      const Number released
          = heats.latent_heat
            - (constant_latent_heat ? 0. : heats.c_l - heats.c_s) * lowered;
      const Freezing<Number> made
          = solute.freeze(deficit, lowered, mass, released, heats);
      const Number x = -(lowered + made.drop);
      const NewIce<Number> ice{made.fraction * mass,
                               made.fraction * mass * heats.c_s * x};
      site.liquid_mass -= ice.mass;
      if(constant_latent_heat)
        site.liquid_heat = site.liquid_mass * (heats.c_l * x + heats.latent_heat);
      else
        site.liquid_heat -= ice.heat;
      return ice;
    }

    /** Melt ice if the liquid is above its liquidus. */
    template <typename Number, typename Solute>
    void melt_ice(SiteContent<Number> &site, const Solute &solute) const
    {
      const Number own = site.ice_heat / site.ice_mass;
      const Number melted = solute.melted(site, own, heats);
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
    template <typename Number, typename Solute>
    bool settle(SiteContent<Number> &site, const Solute &solute) const
    {
      if(!(value_of(site.ice_mass) > 0))
        become_liquid(site);
      if(equilibrium && value_of(site.ice_mass) > 0
         && equilibrate(site, solute, !(value_of(site.liquid_mass) > 0)))
        return true;
      if(freezes(site, solute))
      {
        const NewIce<Number> made = freeze_liquid(site, solute);
        site.ice_mass += made.mass;
        site.ice_heat += made.heat;
      }
      else if(value_of(site.ice_mass) > 0)
        melt_ice(site, solute);
      return equilibrium && value_of(liquid_excess(site)) < eutectic_excess
             && equilibrate(site, solute, true);
    }

    /**
     * Rate at which the liquid freezes while it stays at its liquidus and takes up heat
     * at the rate F and solute at the rate J: with the enthalpy e per mass of what
     * changes phase, that of ice at the liquidus or, where ice melts, of the site's ice,
     * and with PS, a function of the liquid's mass m and its solute S,
     *
     *   E = L m - c_l PS,  dE/dt = F + e dm/dt
     *   =>  dm/dt (L - c_l dPS/dm - e) = F + c_l J dPS/dS.
     */
    template <typename Solute>
    NewIce<double> freezing_rate(const SiteContent<double> &site, const Solute &solute,
                                 double heat_flow, double solute_flow) const
    {
      const double mass = site.liquid_mass;
      const double gain = heat_flow + heats.c_l * solute.slope(mass) * solute_flow;
      const double enthalpy = gain > 0 ? site.ice_heat / site.ice_mass
                                       : -heats.c_s * solute.depression(mass);
      const double rate
          = -gain / (heats.latent_heat - heats.c_l * solute.bend(mass) - enthalpy);
      return {rate, rate * enthalpy};
    }

    /**
     * Enthalpies of a site at which its temperature as a function of these has a kink,
     * ascending: where all has frozen and all eutectic solid has melted, if there is a
     * eutectic; where the last ice has melted.
     */
    template <typename Solute>
    std::array<double, 3> kinks(const Solute &solute) const
    {
      const double liquidus
          = heats.latent_heat * site_mass - heats.c_l * solute.depressed_mass(site_mass);
      if(!std::isfinite(eutectic_excess))
        return {liquidus, liquidus, liquidus};
      const double solid = heats.c_s * eutectic_excess * site_mass;
      const double most = std::min(eutectic_liquid(solute), site_mass);
      const double melted = solid + most * released_at(eutectic_excess);
      return {solid, melted, std::max(liquidus, melted)};
    }

    /** T - T_m of the liquid. */
    template <typename Number>
    Number liquid_excess(const SiteContent<Number> &site) const
    {
      return (site.liquid_heat / site.liquid_mass - heats.latent_heat) / heats.c_l;
    }

    /** T - T_m of the ice. */
    template <typename Number>
    Number ice_excess(const SiteContent<Number> &site) const
    {
      return site.ice_heat / (heats.c_s * site.ice_mass);
    }

    /** At the melting point of the pure solvent (J/kg). */
    double heat_of_melting() const
    {
      return heats.latent_heat;
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

    /** Heat of freezing at x = T - T_m (J/kg). */
    double released_at(double excess) const
    {
      return heats.latent_heat + (heats.c_l - heats.c_s) * excess;
    }

    /** Most liquid that the solute keeps at the eutectic temperature. */
    double eutectic_liquid(const StraightSolute &solute) const
    {
      return solute.depression_mass / -eutectic_excess;
    }

    double eutectic_liquid(const CurvedSolute &solute) const
    {
      return solute.mass / solute.liquidus->eutectic_concentration();
    }

    /** The equilibrium of a site with an enthalpy (J/kg) if both phases are to be kept
     * there, or by force. */
    std::optional<cases::PhaseState>
    kept_state(double enthalpy, const StraightSolute &solute, bool force) const
    {
      const cases::PhaseState state
          = diagram->on_straight(enthalpy, solute.depression_mass / site_mass);
      return force || is_kept(state) ? std::optional(state) : std::nullopt;
    }

    std::optional<cases::PhaseState>
    kept_state(double enthalpy, const CurvedSolute &solute, bool force) const;

    /** Enthalpy (J/kg) up to which both phases of a site are kept in equilibrium. */
    double largest_kept_enthalpy(const CurvedSolute &solute) const;

    /** Put both phases into equilibrium if they are to be kept there, or by force.
     * @return whether that was done. */
    template <typename Number, typename Solute>
    bool equilibrate(SiteContent<Number> &site, const Solute &solute, bool force) const
    {
      const Number heat = site.liquid_heat + site.ice_heat;
      const std::optional<cases::PhaseState> state
          = kept_state(value_of(heat) / site_mass, solute, force);
      if(!state)
        return false;
      const double at = state->temperature - melting_temperature;
      const double released = released_at(at); // per mass that freezes
      const double liquid = state->liquid_fraction;
      const bool fixed
          = liquid > 0 && (state->temperature <= eutectic_temperature || at == 0);
      const bool mush = !fixed && liquid > 0 && liquid < 1;
      const double lever = mush ? solute.lever_slope(site_mass, liquid, at) : 0.;
      const double capacity
          = (1 - liquid) * heats.c_s + liquid * heats.c_l + lever * released;
      const Number x = follow_number(at, fixed ? 0. : 1 / (capacity * site_mass), heat);
      // By the lever rule, at the eutectic temperature by the heat.
      const double slope = fixed ? 1 / released : lever / capacity;
      site.liquid_mass = follow_number(liquid * site_mass, slope, heat);
      site.ice_mass = site_mass - site.liquid_mass;
      // The larger part has the rest: to a part of little mass it would be much.
      if(liquid < 0.5)
      {
        site.liquid_heat = site.liquid_mass * (heats.c_l * x + heats.latent_heat);
        site.ice_heat = heat - site.liquid_heat;
      }
      else
      {
        site.ice_heat = heats.c_s * (site.ice_mass * x);
        site.liquid_heat = heat - site.ice_heat;
      }
      return true;
    }

    const cases::PhaseDiagram *diagram;
    double site_mass;
    double melting_temperature;
    HeatsOfPhases heats;
    double eutectic_temperature, eutectic_excess;
    double crowded; ///< liquid fraction below which crystals leave it too little room
    bool constant_latent_heat, equilibrium;
  };
} // namespace meltfront::particles

#endif
