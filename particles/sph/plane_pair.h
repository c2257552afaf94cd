#ifndef meltfront_particles_sph_plane_pair_h
#define meltfront_particles_sph_plane_pair_h

#include <particles/sph/front_exchange.h>

namespace meltfront::particles
{
  /**
   * What drives heat between particles at a front whose place is known by the signed
   * distance d of each particle (FrontPlanes), with linear temperature in each phase.
   *
   * A solid or liquid particle of the Kirchhoff variable u has the slope u/d across the
   * front, so that a partner at the distance d' sees u (d - d')/d in place of u: this is
   * what a pair with a melting partner exchanges. Between solid and liquid each side
   * takes what its own slope gives; what one leaves over melts or freezes what lies
   * between (FrontExchange::settle). Then a linear temperature in a phase stays as it is
   * whatever way the front runs across the lattice.
   */
  struct PlanePair
  {
    FrontState state;
    double latent_heat;
    const double *distance; ///< from the front, in spacings; negative in the solid
    const double *trust;    ///< in there being a single front, 0 to 1

    /** As far as a single front is not certain, what SubParticlePair gives. Written
     * without branches, so that eight rows advance together. */
    double operator()(std::size_t a, std::size_t b) const
    {
      const double own = state.u[a], other = state.u[b];
      const double difference = other - own;
      const bool melting = own == 0;
      const double partner = melting ? other : own;
      const double factor = slope_factor(distance[melting ? b : a], partner,
                                         std::abs(distance[b] - distance[a]),
                                         melting ? distance[a] : distance[b]);
      const double deviation = own * other > 0 ? 0.
                               : own * other < 0
                                   ? -own * across(distance[a], distance[b]) - difference
                                   : difference * (factor - 1);
      const SubParticlePair fraction{state, latent_heat};
      const double by_line = difference + fraction.latent_share(a, b) * deviation;
      const double by_fraction = fraction(a, b);
      return by_fraction + trust[a] * trust[b] * (by_line - by_fraction);
    }

    /** Of what a solid and a liquid particle leave over, the share of a melting one: 1 in
     * the middle between them, none at either nor beyond. */
    double share_between(std::size_t a, std::size_t b, std::size_t melting) const
    {
      const double place
          = (distance[melting] - distance[a]) / (distance[b] - distance[a]);
      const double share = 1 - std::abs(2 * place - 1) - beside;
      return share > 0 ? share * trust[melting] : 0.;
    }

    /** Whether the front is so near to a solid or liquid particle that its phase changes
     * next. */
    bool reached(std::size_t a) const
    {
      return (state.u[a] < 0 ? -distance[a] : distance[a]) < nearest;
    }

  private:
    /** Spacings from the front at which a particle begins to change phase, so that no
     * slope is taken from one that is nearer. On the lattice a row's coefficients then
     * add up to at most 1.5 times those of u_b - u_a. */
    static constexpr double nearest = 0.4;

    /** Below this share a melting particle lies beside one of the pair, not between. */
    static constexpr double beside = 0.2;

    /** (d - d')/d of a particle of one phase at d to a melting one at d'; none where the
     * melting one lies deeper in the phase. */
    static double slope_factor(double own, double u, double apart, double melting)
    {
      const double depth = u < 0 ? -own : own;
      const double beyond = u < 0 ? melting - own : own - melting;
      return beyond > 0 ? apart / std::max(depth, nearest) : 0.;
    }

    static double across(double own, double other)
    {
      return std::abs(other - own) / std::max(std::abs(own), nearest);
    }
  };
} // namespace meltfront::particles

#endif
