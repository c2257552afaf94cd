#ifndef meltfront_particles_sph_mixture_mixture_exchange_h
#define meltfront_particles_sph_mixture_mixture_exchange_h

#include <cstddef>

namespace meltfront::particles
{
  // Heat flows between two particles of a mixture, per g_ab of ConductionRows. Each is
  // antisymmetric to the last bit: what a pair exchanges cancels exactly.

  /** u_b - u_a of one transformed temperature u. */
  struct DifferencePair
  {
    const double *value; ///< u

    double operator()(std::size_t a, std::size_t b) const
    {
      return value[b] - value[a];
    }
  };

  /** (k_a + k_b)/2 (T_b - T_a) */
  struct ArithmeticMeanPair
  {
    const double *excess;       ///< T - T_m
    const double *conductivity; ///< k

    double operator()(std::size_t a, std::size_t b) const
    {
      return between(conductivity[a], excess[a], conductivity[b], excess[b]);
    }

    static double between(double own_k, double own, double other_k, double other)
    {
      return 0.5 * (own_k + other_k) * (other - own);
    }
  };

  /** 2 k_a k_b/(k_a + k_b) (T_b - T_a), Cleary and Monaghan (1999): of two slabs in
   * contact. */
  struct HarmonicMeanPair
  {
    const double *excess;
    const double *conductivity;

    double operator()(std::size_t a, std::size_t b) const
    {
      return between(conductivity[a], excess[a], conductivity[b], excess[b]);
    }

    static double between(double own_k, double own, double other_k, double other)
    {
      return 2 * own_k * other_k / (own_k + other_k) * (other - own);
    }
  };
} // namespace meltfront::particles

#endif
