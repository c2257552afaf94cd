#ifndef meltfront_particles_sph_front_derivative_h
#define meltfront_particles_sph_front_derivative_h

#include <particles/sph/front_exchange.h>

#include <cmath>

namespace meltfront::particles
{
  /** A change of the state: of both partners' enthalpies, or of one of them. */
  struct FrontChange
  {
    double own_enthalpy, other_enthalpy; ///< J/kg
    double own_u, other_u;               ///< Kirchhoff variable
  };

  /** How SubParticlePair follows a small change of the state. */
  struct SubParticleDerivative
  {
    FrontState state;
    double latent_heat;

    double operator()(std::size_t a, std::size_t b, const FrontChange &change) const
    {
      const double own = state.u[a], other = state.u[b];
      const double difference = other - own;
      const bool melting = own == 0;
      const double molten = melting ? state.enthalpy[a] : state.enthalpy[b];
      const double partner = melting ? other : own;
      const double distance
          = partner < 0 ? 1.5 * latent_heat - molten : 0.5 * latent_heat + molten;
      const double molten_change = melting ? change.own_enthalpy : change.other_enthalpy;
      const double distance_change = partner < 0 ? -molten_change : molten_change;
      const double direct = change.other_u - change.own_u;
      const double ratio = latent_heat / distance;
      const bool across = own * other<0, alike = own * other> 0;
      const Deviation between = across_the_front(own, other, difference, change);
      const double deviation = alike    ? 0.
                               : across ? between.value
                                        : difference * (ratio - 1);
      const double follows
          = alike ? 0.
            : across
                ? between.change
                : direct * (ratio - 1) - difference * ratio / distance * distance_change;
      const double sensible
          = sensible_heat(state.enthalpy[a]) + sensible_heat(state.enthalpy[b]);
      const double sensible_change
          = sensible_slope(state.enthalpy[a]) * change.own_enthalpy
            + sensible_slope(state.enthalpy[b]) * change.other_enthalpy;
      const double share = latent_heat / std::max(latent_heat, sensible);
      const double share_change
          = sensible > latent_heat ? -share / sensible * sensible_change : 0.;
      return direct + share_change * deviation + share * follows;
    }

    /** Of SubParticlePair::from_wall. */
    double from_wall(std::size_t a, double wall, double enthalpy_change,
                     double u_change) const
    {
      const double own = state.u[a], enthalpy = state.enthalpy[a];
      if(own == 0)
      {
        const double molten = enthalpy / latent_heat;
        const double distance = 2 * (wall < 0 ? 1 - molten : molten);
        const double slope = (wall < 0 ? -2 : 2) / latent_heat;
        return distance > 0.5 ? -wall / (distance * distance) * slope * enthalpy_change
                              : 0.;
      }
      const double difference = wall - own;
      if(own < 0 ? wall <= 0 : wall >= 0)
        return -u_change;
      const Deviation between
          = across_the_front(own, wall, difference, {0, 0, u_change, 0});
      const double sensible = sensible_heat(enthalpy);
      const double share = latent_heat / std::max(latent_heat, sensible);
      const double share_change
          = sensible > latent_heat
                ? -share / sensible * sensible_slope(enthalpy) * enthalpy_change
                : 0.;
      return -u_change + share_change * between.value + share * between.change;
    }

  private:
    struct Deviation
    {
      double value, change;
    };

    /** Between solid and liquid: + or - ||u_a| - |u_b||. */
    static Deviation across_the_front(double own, double other, double difference,
                                      const FrontChange &change)
    {
      const double excess = std::abs(own) - std::abs(other);
      const double excess_change = (own < 0 ? -change.own_u : change.own_u)
                                   - (other < 0 ? -change.other_u : change.other_u);
      return {std::copysign(std::abs(excess), difference),
              std::copysign(1., excess) * std::copysign(1., difference) * excess_change};
    }

    /** |c (T - T_m)| and its slope. */
    double sensible_heat(double enthalpy) const
    {
      return std::max(-enthalpy, 0.) + std::max(enthalpy - latent_heat, 0.);
    }

    double sensible_slope(double enthalpy) const
    {
      return enthalpy < 0 ? -1. : enthalpy > latent_heat ? 1. : 0.;
    }
  };

  /** How HarmonicPair follows a small change of the state. */
  struct HarmonicDerivative
  {
    HarmonicPair pair;

    double operator()(std::size_t a, std::size_t b, const FrontChange &change) const
    {
      return between(pair.state.u[a], pair.state.u[b], change.own_u, change.other_u);
    }

    double from_wall(std::size_t a, double wall, double, double u_change) const
    {
      return between(pair.state.u[a], wall, u_change, 0);
    }

  private:
    double between(double own, double other, double own_change, double other_change) const
    {
      if(!pair.exchanges_across(own, other))
        return other_change - own_change;
      return other_change * pair.scale(other) - own_change * pair.scale(own);
    }
  };

  /** Where no phase matters: u_b - u_a. */
  struct PlainDerivative
  {
    double operator()(std::size_t, std::size_t, const FrontChange &change) const
    {
      return change.other_u - change.own_u;
    }

    double from_wall(std::size_t, double, double, double u_change) const
    {
      return -u_change;
    }
  };

  inline SubParticleDerivative derivative_of(const SubParticlePair &pair)
  {
    return {pair.state, pair.latent_heat};
  }

  inline HarmonicDerivative derivative_of(const HarmonicPair &pair)
  {
    return {pair};
  }
} // namespace meltfront::particles

#endif
