#ifndef meltfront_cases_exact_frank_h
#define meltfront_cases_exact_frank_h

#include <cases/exact/radial_similarity.h>

namespace meltfront::cases
{
  /**
   * A plate, cylinder or sphere of solid at the melting temperature that grows from
   * nothing into undercooled melt (Frank 1950). Front R = S sqrt(a_l t); with z = S^2/4
   * and d = 1, 2, 3 dimensions
   *
   *   z^(d/2) e^z Gamma(1 - d/2, z) = c_l (T_m - T_far)/L.
   *
   * An enthalpy method cannot hold undercooled liquid: for methods that track the front.
   */
  class FrankGrowth : public RadialSimilarity
  {
  public:
    /**
     * @throws InputError unless 0 < c_l (T_m - T_far)/L < 1, for a property that is not
     * positive, unequal densities, or a symmetry that is none.
     */
    FrankGrowth(const Material &material, Symmetry symmetry, double far_temperature);

    /** S of R = S sqrt(a_l t). */
    double growth_constant() const;

    std::string description() const override;
  };
} // namespace meltfront::cases

#endif
