#ifndef meltfront_reference_fem_enthalpy_liquidus_h
#define meltfront_reference_fem_enthalpy_liquidus_h

#include <cases/alloy.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace meltfront::reference_fem
{
  /** A liquidus that is depressed by less (K) is the pure solvent's: less drowns in the
   * round-off of temperatures, and ahead of solute that spreads there is as little of it
   * as a double can hold. */
  inline constexpr double least_depression = 1e-10;

  /** What is dissolved at a node. */
  struct Composition
  {
    double solute;     ///< in the unit of Liquidus
    double depression; ///< T_m - T_L (K) if all of the node were liquid
  };

  /**
   * The liquidus of an alloy, both ways: the depression d = T_m - T_L (K) of a liquid,
   * and the solute y of the liquid that is in equilibrium with crystals at a depression.
   * A straight liquidus measures solute by its depression, y = d = sum of slope_s C_s; a
   * curved one, of a single solute, by its mass fraction, d = curve(C).
   *
   * Mush that has kept its solute X holds the mass fraction X/y(d) of liquid (lever
   * rule).
   *
   * Beyond the largest known concentration a curve goes on straight, since an iteration
   * may pass through there; a solution must not be there.
   */
  class Liquidus
  {
  public:
    /** @throws cases::InputError if a curve does not rise up to the largest concentration
     * or is not zero at zero */
    explicit Liquidus(const cases::Alloy &alloy);

    bool straight() const
    {
      return knots.empty();
    }

    double depression(double solute) const
    {
      return straight() ? solute : on_curve(solute);
    }

    /** y(d); zero at d <= 0. */
    double solute_at(double depression) const
    {
      if(straight())
        return depression;
      return find([depression](double, double there) { return there - depression; }, 0);
    }

    /** dd/dy (central difference of a curve, relative error about 1e-9). */
    double slope(double solute) const;

    /** Mean of 1/y over the depressions from low to high, 0 < low < high. */
    double mean_dilution(double low, double high) const;

    /** Largest depression that the liquidus is known for (K); infinity if it is straight.
     */
    double largest_depression() const;

    /**
     * Where on a curve a surplus(y, d(y)) that rises with y vanishes, at least at `from`.
     * Points of the curve that are kept bracket it within four percent without an
     * evaluation of the curve; Alefeld, Potra and Shi (1995, algorithm 748, from Boost)
     * do the rest, to round-off.
     */
    template <typename Surplus>
    double find(const Surplus &surplus, double from) const;

  private:
    struct Knot
    {
      double solute, depression;
      double dilution; ///< integral of dd/y from the first knot but zero
    };

    double on_curve(double solute) const;
    double integrated_dilution(const Knot &lower, const Knot &upper) const;

    std::function<double(double)> curve;
    std::vector<Knot> knots; ///< from zero on; empty for a straight liquidus
    double last_slope = 0;   ///< with which a curve goes on (K)
  };

  template <typename Surplus>
  double Liquidus::find(const Surplus &surplus, double from) const
  {
    const auto at = [&](double solute) { return surplus(solute, on_curve(solute)); };
    const auto above = std::partition_point(
        knots.begin(), knots.end(),
        [&](const Knot &knot)
        { return knot.solute <= from || surplus(knot.solute, knot.depression) < 0; });
    double lower = from, upper = 0;
    if(above != knots.begin())
      lower = std::max(from, std::prev(above)->solute);
    if(above != knots.end())
      upper = above->solute;
    else
      for(upper = 2 * lower; at(upper) < 0; upper *= 2)
        lower = upper;
    const double at_lower = at(lower), at_upper = at(upper);
    // Round-off at an end.
    if(!(at_lower < 0))
      return lower;
    if(!(at_upper > 0))
      return upper;
    std::uintmax_t iterations = 100;
    const auto closed
        = [](double a, double b) { return std::abs(a - b) <= 2e-16 * std::abs(b); };
    const auto bracket = boost::math::tools::toms748_solve(at, lower, upper, at_lower,
                                                           at_upper, closed, iterations);
    return 0.5 * (bracket.first + bracket.second);
  }
} // namespace meltfront::reference_fem

#endif
