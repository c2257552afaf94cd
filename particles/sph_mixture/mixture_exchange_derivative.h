#ifndef meltfront_particles_sph_mixture_mixture_exchange_derivative_h
#define meltfront_particles_sph_mixture_mixture_exchange_derivative_h

#include <algorithm>
#include <cstddef>

namespace meltfront::particles
{
  /** Changes of two particles. */
  struct PairChange
  {
    double own, other;                           ///< of T, or of what stands for it
    double own_conductivity, other_conductivity; ///< of k
  };

  // How the flows of mixture_exchange.h and IntegralMeanPair follow such changes, to
  // first order.

  /** Of DifferencePair. */
  struct DifferenceDerivative
  {
    double operator()(std::size_t, std::size_t, const PairChange &change) const
    {
      return change.other - change.own;
    }
  };

  /** Of ArithmeticMeanPair. */
  struct ArithmeticMeanDerivative
  {
    const double *excess, *conductivity;

    double operator()(std::size_t a, std::size_t b, const PairChange &change) const
    {
      return between(conductivity[a], excess[a], conductivity[b], excess[b], change);
    }

    static double between(double own_k, double own, double other_k, double other,
                          const PairChange &change)
    {
      return 0.5 * (change.own_conductivity + change.other_conductivity) * (other - own)
             + 0.5 * (own_k + other_k) * (change.other - change.own);
    }
  };

  /** Of HarmonicMeanPair. */
  struct HarmonicMeanDerivative
  {
    const double *excess, *conductivity;

    double operator()(std::size_t a, std::size_t b, const PairChange &change) const
    {
      return between(conductivity[a], excess[a], conductivity[b], excess[b], change);
    }

    static double between(double own_k, double own, double other_k, double other,
                          const PairChange &change)
    {
      const double inverse = 1 / (own_k + other_k);
      const double own_weight = other_k * inverse, other_weight = own_k * inverse;
      const double mean_change
          = 2
            * (own_weight * own_weight * change.own_conductivity
               + other_weight * other_weight * change.other_conductivity);
      return mean_change * (other - own)
             + 2 * own_k * own_weight * (change.other - change.own);
    }
  };

  /**
   * Of IntegralMeanPair: by dx_b the flow changes by k_l + (k_s - k_l)/2 [v(x_b; P_a) +
   * v(x_b; P_b)], v the solid's volume fraction at equilibrium, as of SolidPath.
   */
  struct IntegralMeanDerivative
  {
    const double *linear;     ///< k_l; below the eutectic temperature that of the solid
    const double *weight;     ///< (k_s - k_l)/2 where v depends on P, else 0
    const double *inverse;    ///< 1/x, where it counts
    const double *own;        ///< v(x; P) of the particle's own P
    const double *depression; ///< P
    double expansion;         ///< r

    double operator()(std::size_t a, std::size_t b, const PairChange &change) const
    {
      return conductivity(b, a) * change.other - conductivity(a, b) * change.own;
    }

    /** At a particle's temperature, the mean over its and a partner's composition. */
    double conductivity(std::size_t own_row, std::size_t partner) const
    {
      const double volume = expansion * (1 + depression[partner] * inverse[own_row]);
      return linear[own_row]
             + weight[own_row] * (own[own_row] + std::clamp(volume, 0., 1.));
    }
  };
} // namespace meltfront::particles

#endif
