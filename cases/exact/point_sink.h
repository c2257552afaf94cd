#ifndef meltfront_cases_exact_point_sink_h
#define meltfront_cases_exact_point_sink_h

#include <cases/exact/radial_similarity.h>

namespace meltfront::cases
{
  /**
   * Freezing around a point that draws Q(t) = 4 pi k_s A sqrt(a_s t) out of unbounded
   * liquid at a uniform temperature (from Frank's functions of 1950). With
   * F3(s) = e^(-s^2/4)/s - sqrt(pi)/2 erfc(s/2) and s_l = 2 lambda sqrt(a_s/a_l):
   *
   *   T_s = T_m + A [F3(2 lambda) - F3(r/sqrt(a_s t))],
   *   T_l = T_far - (T_far - T_m) F3(r/sqrt(a_l t))/F3(s_l),
   *   k_s A e^(-lambda^2)/(4 lambda^2 sqrt(a_s))
   *     - k_l (T_far - T_m) e^(-s_l^2/4)/(s_l^2 F3(s_l) sqrt(a_l)) = rho L lambda
   * sqrt(a_s).
   */
  class PointSink : public RadialSimilarity
  {
  public:
    /**
     * @param lambda  the front constant that the sink is to drive: its strength follows
     * @throws InputError for lambda <= 0, a far temperature below the melting
     * temperature, a property that is not positive, or unequal densities.
     */
    PointSink(const Material &material, double lambda, double far_temperature);

    /** A (K). */
    double amplitude() const;

    /** Q(t), the heat removed per time (W). */
    double strength(double time) const;

    /** The heat removed from 0 to t (J). */
    double energy(double time) const;

    std::string description() const override;
  };
} // namespace meltfront::cases

#endif
