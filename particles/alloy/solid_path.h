#ifndef meltfront_particles_alloy_solid_path_h
#define meltfront_particles_alloy_solid_path_h

#include <particles/alloy/substance.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meltfront::particles
{
  /**
   * The integral of the solid's volume fraction over the temperature, along the
   * equilibrium of one composition with a straight liquidus,
   *
   *   G(x; P) = int_(-P)^x v(y; P) dy <= 0,  v(y; P) = min(1, r (1 + P/y)) below -P,
   *
   * x = T - T_m, P the depression of the liquidus, r the density over the crystals'. With
   * it k_l x + (k_s - k_l) G is Kirchhoff's transform of the temperature, whose
   * differences drive heat exactly however much k varies between two particles; for P = 0
   * it is k (T - T_m).
   *
   *   mush:                     G = r (x + P ln(-x) + Q),  Q = P (1 - ln P)
   *   wholly solid in volume:   G = v_1 x + kappa P,       v_1 = min(r, 1)
   *
   * Below the eutectic temperature all is solid: v = v_1.
   */
  class SolidPath
  {
  public:
    explicit SolidPath(const AlloySubstance &substance)
      : r(substance.expansion)
      , most(std::min(r, 1.))
      , eutectic_excess(substance.eutectic_excess)
      // Where r > 1 crystals fill the volume at x = -ratio P, with liquid left by mass.
      , ratio(r > 1 ? r / (r - 1) : 1e300)
      , offset(r > 1 ? r * (1 - ratio + std::log(ratio)) + ratio : 0)
    {
    }

    /** What of a state above the eutectic temperature enters G. */
    struct Point
    {
      double excess;    ///< x, at least that of the eutectic temperature
      double logarithm; ///< ln(-x), where x < 0
    };

    Point point(double excess) const
    {
      const double above = std::max(excess, eutectic_excess);
      return {above, std::log(std::max(-above, 1e-300))};
    }

    /** Q(P) */
    static double constant(double depression)
    {
      return depression > 0 ? depression * (1 - std::log(depression)) : 0;
    }

    /** G above the eutectic temperature; without branches. */
    double integral(double excess, double logarithm, double depression,
                    double constant) const
    {
      const double mush = r * (excess + depression * logarithm + constant);
      const double solid = most * excess + offset * depression;
      const double frozen = excess > -ratio * depression ? mush : solid;
      return excess >= -depression ? 0. : frozen;
    }

    /** The rest of G below the eutectic temperature, the same for all compositions. */
    double below_eutectic(double excess) const
    {
      return most * std::min(excess - eutectic_excess, 0.);
    }

    /** G from start to end. */
    double whole(double excess, double depression) const
    {
      const Point p = point(excess);
      const double rest = std::isfinite(eutectic_excess) ? below_eutectic(excess) : 0.;
      return integral(p.excess, p.logarithm, depression, constant(depression)) + rest;
    }

  private:
    double r, most, eutectic_excess, ratio, offset;
  };

  /**
   * Heat flow by the mean conductivity over the temperatures between two particles. Where
   * their compositions differ, the mean of the integrals along both:
   *
   *   k_l (x_b - x_a) + (k_s - k_l)/2 sum over P_a, P_b of [G(x_b; P) - G(x_a; P)].
   */
  struct IntegralMeanPair
  {
    const double *linear;     ///< k_l x + (k_s - k_l) G below the eutectic temperature
    const double *excess;     ///< SolidPath::Point
    const double *logarithm;  ///< SolidPath::Point
    const double *depression; ///< P
    const double *constant;   ///< Q(P)
    const double *own;        ///< G(x; P) of the particle's own P
    double half_difference;   ///< (k_s - k_l)/2
    SolidPath path;

    double operator()(std::size_t a, std::size_t b) const
    {
      const double b_on_a
          = path.integral(excess[b], logarithm[b], depression[a], constant[a]);
      const double a_on_b
          = path.integral(excess[a], logarithm[a], depression[b], constant[b]);
      return (linear[b] - linear[a])
             + half_difference * ((b_on_a - own[a]) + (own[b] - a_on_b));
    }
  };
} // namespace meltfront::particles

#endif
