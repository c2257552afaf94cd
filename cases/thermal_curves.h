#ifndef meltfront_cases_thermal_curves_h
#define meltfront_cases_thermal_curves_h

#include <cstddef>
#include <span>
#include <vector>

namespace meltfront::cases
{
  struct Material;

  /** A pure substance in equilibrium. */
  struct ThermalState
  {
    double temperature; ///< K or degrees Celsius, as the scene's
    double enthalpy;    ///< J/kg
    double kirchhoff;   ///< u, the integral of k from the melting temperature (W/m)
    double solid_fraction;
    double conductivity; ///< k = du/dT (W/(m K))
    double capacity;     ///< dH/dT (J/(kg K)), with the latent heat that a melting range
                         ///< spreads over temperatures; infinite within the jump
  };

  /**
   * A material whose properties depend on temperature, or that melts over a range of
   * temperatures, as one monotone graph: of temperature T, specific enthalpy H (J/kg) and
   * Kirchhoff's variable u (W/m) each tells the others,
   *
   *   H(T) = int_{T_m}^{T} (c - L df_s/dT) dT,   u(T) = int_{T_m}^{T} k dT,
   *   k = f_s k_s + (1 - f_s) k_l,   c = f_s c_s + (1 - f_s) c_l,
   *
   * where f_s is the solid's fraction and T_m the melting temperature, or the solidus of
   * a melting range. H and u are zero for the solid at T_m; there H jumps by jump() while
   * u is zero: by all of L without a range, with one by the latent heat of what is liquid
   * still at the solidus. k, c and f_s are linear between knots, H and u parabolas.
   * Conduction is linear in u whatever k is: div(k grad T) = lap u.
   *
   * Beyond the first and the last knot k and c keep their values.
   */
  class ThermalCurves
  {
  public:
    /** @throws InputError if a property is not positive or the solid fraction rises with
     * temperature */
    explicit ThermalCurves(const Material &material);

    /** At T; at T_m the upper end of the jump. */
    ThermalState at_temperature(double temperature) const;

    /** At an enthalpy (J/kg); within the jump T = T_m and u = 0. */
    ThermalState at_enthalpy(double enthalpy) const;

    /** At Kirchhoff's variable (W/m); at u = 0 the upper end of the jump. */
    ThermalState at_kirchhoff(double kirchhoff) const;

    /**
     * The one state in which mass H + stiffness u + transfer (T - T_m) = target, all
     * factors >= 0, mass > 0.
     */
    ThermalState resolve(double target, double mass, double stiffness,
                         double transfer = 0) const;

    /** Latent heat that is exchanged at T_m itself (J/kg). */
    double jump() const
    {
      return latent_jump;
    }

    double melting_temperature() const
    {
      return reference;
    }

    /** Least dH/du (J m/(kg W)) off the jump at temperatures between two bounds: what the
     * length of explicit steps goes by. */
    double least_slope(double lowest, double highest) const;

    /** Where the pieces of the graph meet, ascending; T_m is one (K). */
    std::span<const double> knots() const
    {
      return temperatures;
    }

  private:
    struct Factors
    {
      double mass, stiffness, transfer;
    };

    /** At one end of a piece, seen from within. */
    struct End
    {
      double conductivity, capacity, solid_fraction;
    };

    struct Piece
    {
      End lower, upper;
    };

    void integrate();
    ThermalState solve(double target, const Factors &factors) const;
    ThermalState in_jump(double enthalpy) const;

    /** Of the factors' sum at a knot; at T_m above the jump. */
    double at_knot(std::size_t knot, const Factors &factors) const;

    double reference, latent_heat, latent_jump = 0;
    std::size_t melting_knot = 0;
    std::vector<double> temperatures;
    std::vector<double> enthalpies; ///< at the knots; at T_m above the jump
    std::vector<double> kirchhoffs;
    /** Before the first knot, between a knot and the next, beyond the last. */
    std::vector<Piece> pieces;
  };
} // namespace meltfront::cases

#endif
