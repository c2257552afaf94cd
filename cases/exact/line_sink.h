#ifndef meltfront_cases_exact_line_sink_h
#define meltfront_cases_exact_line_sink_h

#include <cases/exact/radial_similarity.h>

namespace meltfront::cases
{
  /**
   * Freezing around a line that draws Q (W/m) from t = 0 on, out of unbounded liquid at a
   * uniform temperature: Monaghan, Huppert and Worster 2005, equations 3.7-3.10,
   * corrected (arguments r^2/(4 a t) without pi, each with its phase's own diffusivity;
   * conductivity in the prefactor):
   *
   *   T_s = T_m + Q/(4 pi k_s) [E1(lambda^2) - E1(r^2/(4 a_s t))],
   *   T_l = T_far - (T_far - T_m) E1(r^2/(4 a_l t))/E1(z),   z = lambda^2 a_s/a_l,
   *   Q/(4 pi) e^(-lambda^2) - k_l (T_far - T_m) e^(-z)/E1(z) = a_s rho L lambda^2.
   */
  class LineSink : public RadialSimilarity
  {
  public:
    /**
     * @param lambda  the front constant that the sink is to drive: its strength follows
     * @throws InputError for lambda <= 0, a far temperature below the melting
     * temperature, a property that is not positive, or unequal densities.
     */
    LineSink(const Material &material, double lambda, double far_temperature);

    /** Q, the heat removed per time and length (W/m). */
    double strength() const;

    std::string description() const override;
  };
} // namespace meltfront::cases

#endif
