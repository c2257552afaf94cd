#ifndef meltfront_particles_sph_two_population_site_liquidus_h
#define meltfront_particles_sph_two_population_site_liquidus_h

#include <particles/sph_two_population/curved_liquidus.h>
#include <particles/sph_two_population/dual_number.h>

#include <cmath>
#include <limits>
#include <type_traits>

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

  /** Heat capacities of ice and liquid (J/(kg K)), and the latent heat at T_m (J/kg). */
  struct HeatsOfPhases
  {
    double c_s, c_l, latent_heat;
  };

  // What a site has dissolved, and how its liquid, all of which holds it, begins to
  // freeze by it: SiteExchange takes either of these, straight or curved.

  /** Under a straight liquidus: all that matters is PS, depression times mass. */
  struct StraightSolute
  {
    double depression_mass; ///< PS (K kg m^(d-3))

    /** P of a liquid of that mass. */
    template <typename Number>
    Number depression(const Number &mass) const
    {
      return depression_mass / mass;
    }

    /** P times the mass. */
    double depressed_mass(double) const
    {
      return depression_mass;
    }

    /** Derivative of PS by what is dissolved, in a liquid of a given mass. */
    double slope(double) const
    {
      return 1;
    }

    /** Change of PS with the mass of the liquid. */
    double bend(double) const
    {
      return 0;
    }

    /** Mass fraction of liquid that a mush's temperature x = T - T_m gives (1/K). */
    double lever_slope(double site_mass, double, double excess) const
    {
      return depression_mass / site_mass / (excess * excess);
    }

    /** What the liquid, P lowered, does when it loses heat (J/kg). */
    template <typename Number>
    Freezing<Number> freeze(const Number &heat, const Number &lowered, const Number &,
                            const Number &released, const HeatsOfPhases &heats) const
    {
      return particles::freeze(heat, lowered, released, heats.c_s, heats.c_l);
    }

    /** Mass of ice of the enthalpy e (J/kg) that melts, if there is enough; not positive
     * at or below the liquidus. */
    template <typename Number>
    Number melted(const SiteContent<Number> &site, const Number &own,
                  const HeatsOfPhases &heats) const
    {
      const Number after
          = (site.liquid_heat - site.liquid_mass * own + heats.c_l * depression_mass)
            / (heats.latent_heat - own);
      return after - site.liquid_mass;
    }
  };

  /** Under a curved liquidus: y = S/m is the mass fraction in a liquid of the mass m. */
  struct CurvedSolute
  {
    const CurvedLiquidus *liquidus;
    double mass; ///< S (kg m^(d-3))

    double depression(double liquid_mass) const
    {
      return liquidus->depression(mass / liquid_mass);
    }

    DualNumber depression(const DualNumber &liquid_mass) const
    {
      const double y = mass / liquid_mass.value;
      return liquid_mass.chain(liquidus->depression(y),
                               -liquidus->slope(y) * y / liquid_mass.value);
    }

    double depressed_mass(double liquid_mass) const
    {
      return liquid_mass * depression(liquid_mass);
    }

    double slope(double liquid_mass) const
    {
      return liquidus->slope(mass / liquid_mass);
    }

    double bend(double liquid_mass) const
    {
      const double y = mass / liquid_mass;
      return liquidus->depression(y) - y * liquidus->slope(y);
    }

    double lever_slope(double site_mass, double fraction, double) const
    {
      const double y = mass / (site_mass * fraction);
      return fraction / (y * liquidus->slope(y));
    }

    /**
     * The fraction phi of the mass m that freezes:
     *
     *   q = phi (L + c_s d) + (1 - phi) c_l d,  d = P(S/(m (1 - phi))) - P(S/m),
     *
     * whose right-hand side rises with phi. The start is the straight line through T_m
     * and this liquid.
     */
    template <typename Number>
    Freezing<Number> freeze(const Number &heat, const Number &lowered,
                            const Number &liquid_mass, const Number &released,
                            const HeatsOfPhases &heats) const
    {
      if(value_of(heat) <= 0)
        return {0., 0.};
      const auto taken = [&heats](const auto &phi, const auto &drop, const auto &latent)
      { return phi * latent + (phi * heats.c_s + (1 - phi) * heats.c_l) * drop; };
      const double q = value_of(heat), m = value_of(liquid_mass), p = value_of(lowered),
                   latent = value_of(released);
      const double phi = rising_root(
          [&](double part)
          { return taken(part, depression(m * (1 - part)) - p, latent) - q; },
          0., -q, 1., particles::freeze(q, p, latent, heats.c_s, heats.c_l).fraction,
          std::numeric_limits<double>::epsilon());
      if constexpr(std::is_same_v<Number, double>)
        return {depression(m * (1 - phi)) - p, phi};
      else
      {
        // One step of Newton's method carries the derivatives.
        const Number drop = depression(liquid_mass * (1 - phi)) - lowered;
        const double y = mass / (m * (1 - phi));
        const double rate = latent + (heats.c_s - heats.c_l) * value_of(drop)
                            + (phi * heats.c_s + (1 - phi) * heats.c_l) * y
                                  * liquidus->slope(y) / (1 - phi);
        const Number surplus = taken(Number(phi), drop, released) - heat;
        const Number fraction = phi - surplus / rate;
        return {depression(liquid_mass * (1 - fraction)) - lowered, fraction};
      }
    }

    /**
     * Where ice of the enthalpy e per mass melts into liquid of the heat E,
     *
     *   E + delta e = (m + delta)(L - c_l P(S/(m + delta))).
     */
    template <typename Number>
    Number melted(const SiteContent<Number> &site, const Number &own,
                  const HeatsOfPhases &heats) const
    {
      const auto surplus = [&heats](const auto &part, const auto &from, const auto &drop,
                                    const auto &enthalpy)
      {
        return (from.liquid_mass + part) * (heats.latent_heat - heats.c_l * drop)
               - from.liquid_heat - part * enthalpy;
      };
      const SiteContent<double> from{value_of(site.liquid_mass),
                                     value_of(site.liquid_heat), value_of(site.ice_mass),
                                     value_of(site.ice_heat)};
      const double e = value_of(own);
      const auto at = [&](double part)
      { return surplus(part, from, depression(from.liquid_mass + part), e); };
      const double at_none = at(0);
      if(at_none >= 0)
        return 0.;
      if(at(from.ice_mass) <= 0)
        return site.ice_mass;
      const double start
          = StraightSolute{depressed_mass(from.liquid_mass)}.melted(from, e, heats);
      const double delta = rising_root(at, 0., at_none, from.ice_mass, start,
                                       std::numeric_limits<double>::epsilon()
                                           * (from.liquid_mass + from.ice_mass));
      if constexpr(std::is_same_v<Number, double>)
        return delta;
      else
      {
        const double after = from.liquid_mass + delta;
        const double rate = heats.latent_heat - heats.c_l * bend(after) - e;
        return delta
               - surplus(delta, site, depression(site.liquid_mass + delta), own) / rate;
      }
    }
  };
} // namespace meltfront::particles

#endif
