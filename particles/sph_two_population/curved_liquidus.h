#ifndef meltfront_particles_sph_two_population_curved_liquidus_h
#define meltfront_particles_sph_two_population_curved_liquidus_h

#include <particles/alloy/substance.h>

#include <cmath>
#include <functional>

namespace meltfront::particles
{
  /**
   * Where a surplus that rises from below zero at `lower` vanishes, below `upper`: the
   * secant method from a good start, kept within the bracket that its signs give, and
   * bisection where it does not end soon (after Dekker 1969).
   *
   * @param at_lower surplus there, not positive; `upper` itself is never evaluated.
   * @param tolerance absolute; ends at the latest when the bracket is that narrow.
   */
  template <typename Surplus>
  double rising_root(const Surplus &surplus, double lower, double at_lower, double upper,
                     double start, double tolerance)
  {
    constexpr int most_secants = 24, most_iterations = 160;
    double previous = lower, at_previous = at_lower;
    double x = start > lower && start < upper ? start : 0.5 * (lower + upper);
    for(int i = 0; i < most_iterations; ++i)
    {
      const double value = surplus(x);
      if(value == 0)
        return x;
      (value < 0 ? lower : upper) = x;
      double next = x - value * (x - previous) / (value - at_previous);
      if(std::abs(next - x) <= tolerance)
        return std::min(std::max(next, lower), upper);
      if(i >= most_secants || !(next > lower && next < upper))
        next = 0.5 * (lower + upper);
      if(upper - lower <= tolerance)
        return next;
      previous = x;
      at_previous = value;
      x = next;
    }
    return x;
  }

  /**
   * The curved liquidus of a single solute: the depression P(y) = T_m - T_L of a liquid
   * with the mass fraction y.
   *
   * Beyond the largest known mass fraction it goes on straight, since iterations may pass
   * through there; no state of a run may be there (Sites::beyond_liquidus).
   */
  class CurvedLiquidus
  {
  public:
    /** @throws cases::InputError unless the curve rises from zero at zero. */
    explicit CurvedLiquidus(const AlloySubstance &substance);

    double depression(double y) const
    {
      return y <= largest ? curve(y) : last + last_slope * (y - largest);
    }

    /** P'(y), by a central difference (relative error about 1e-9). */
    double slope(double y) const;

    /** y(P) >= 0. */
    double solute_at(double depression) const;

    /**
     * The integral of the solid's volume fraction over the temperature, as SolidPath has
     * it for straight lines: along the equilibrium of the mass fraction C of all, in the
     * mush with the density r over the crystals'
     *
     *   G(x; C) = int_(-P(C))^x r (1 - C/y) dx' = -r [P(y) - P(C) - C int dP/y],
     *   int dP/y = [P/y] + int P/y^2 dy,  -P(y) = x = T - T_m.
     */
    double solid_path(double excess, double concentration) const;

    double largest_concentration() const
    {
      return largest;
    }

    /** y of the liquid at the eutectic temperature; infinity for none. */
    double eutectic_concentration() const
    {
      return at_eutectic;
    }

  private:
    std::function<double(double)> curve;
    double largest, last, last_slope = 0;
    double expansion, eutectic_excess;
    double at_eutectic;
  };
} // namespace meltfront::particles

#endif
