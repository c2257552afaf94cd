#ifndef meltfront_particles_sph_two_population_two_population_exchange_h
#define meltfront_particles_sph_two_population_two_population_exchange_h

#include <particles/sph_two_population/sites.h>

#include <cstddef>

namespace meltfront::particles
{
  // Heat flows into a particle of one population from both particles of another site, per
  // g_ab of ConductionRows. What two particles exchange is antisymmetric to the last bit.

  /** A population as the exchange sees it. */
  struct PopulationView
  {
    explicit PopulationView(const Population &population)
      : share(population.share.data())
      , excess(population.excess.data())
    {
    }

    /** The population's volumes at other temperatures. */
    PopulationView(const Population &population, const double *excess)
      : share(population.share.data())
      , excess(excess)
    {
    }

    const double *share;  ///< volume over the site's
    const double *excess; ///< T - T_m
  };

  /**
   * Intrinsic volumes; within a phase its conductivity, between the phases the mean:
   *
   *   v_p v_q k_pq (T_q - T_p),  k_ls = (k_l + k_s)/2.
   *
   * At one temperature gradient both populations together conduct with
   * v_l^2 k_l + v_s^2 k_s + 2 v_l v_s k_ls = v_l k_l + v_s k_s, as a mush does.
   */
  struct CorrectedPair
  {
    PopulationView own, other;
    bool of_ice;    ///< the own population is ice
    double within;  ///< conductivity of the own phase
    double between; ///< (k_l + k_s)/2

    double operator()(std::size_t a, std::size_t b) const
    {
      const double x = own.excess[a], share = own.share[a];
      return (share * own.share[b]) * (within * (own.excess[b] - x))
             + (share * other.share[b]) * (between * (other.excess[b] - x));
    }

    /** With the other particle of the same site. */
    double at_site(std::size_t a) const
    {
      return (own.share[a] * other.share[a])
             * (between * (other.excess[a] - own.excess[a]));
    }

    /** Of the exchange with a wall in which the other phase has a share of the volume. */
    double wall_conductivity(std::size_t a, double other_share) const
    {
      return own.share[a] * ((1 - other_share) * within + other_share * between);
    }

    double from_wall(std::size_t a, double wall_excess, double other_share) const
    {
      return wall_conductivity(a, other_share) * (wall_excess - own.excess[a]);
    }
  };

  /** What all that a particle exchanges by CorrectedPair falls by, per its own
   * temperature. */
  struct CorrectedPairSlope
  {
    CorrectedPair pair;

    double operator()(std::size_t a, std::size_t b) const
    {
      return b == a ? 0.
                    : pair.own.share[a]
                          * (pair.own.share[b] * pair.within
                             + pair.other.share[b] * pair.between);
    }

    double at_site(std::size_t a) const
    {
      return pair.own.share[a] * pair.other.share[a] * pair.between;
    }
  };

  /**
   * As published (Monaghan, Huppert and Worster 2005, equation 4.2): volumes m/(theta
   * rho) with the ice's volume fraction from its density summed over the kernel, and the
   * harmonic mean of the conductivities times volume fractions, v_p v_q 2 k_p k_q/(k_p +
   * k_q) (T_q - T_p).
   */
  struct PublishedPair
  {
    PopulationView own, other;
    const double *solid; ///< volume fraction
    bool of_ice;         ///< the own population is ice
    double own_conductivity, other_conductivity;

    double own_effective(std::size_t a) const
    {
      return own_conductivity * (of_ice ? solid[a] : 1 - solid[a]);
    }

    double other_effective(std::size_t a) const
    {
      return other_conductivity * (of_ice ? 1 - solid[a] : solid[a]);
    }

    static double harmonic(double first, double second)
    {
      // Both vanish where neither phase is: the least number keeps 0/0 away.
      return 2 * first * second / (first + second + 1e-300);
    }

    double operator()(std::size_t a, std::size_t b) const
    {
      const double x = own.excess[a], share = own.share[a], k = own_effective(a);
      return (share * own.share[b])
                 * (harmonic(k, own_effective(b)) * (own.excess[b] - x))
             + (share * other.share[b])
                   * (harmonic(k, other_effective(b)) * (other.excess[b] - x));
    }

    double at_site(std::size_t a) const
    {
      return (own.share[a] * other.share[a])
             * (harmonic(own_effective(a), other_effective(a))
                * (other.excess[a] - own.excess[a]));
    }

    /** From a wall, as if its volume were shared as the site's. */
    double from_wall(std::size_t a, double wall_excess, double) const
    {
      const double k = own_effective(a);
      return own.share[a]
             * (own.share[a] * k + other.share[a] * harmonic(k, other_effective(a)))
             * (wall_excess - own.excess[a]);
    }
  };
} // namespace meltfront::particles

#endif
