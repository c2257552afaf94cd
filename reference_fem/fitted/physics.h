#ifndef meltfront_reference_fem_fitted_physics_h
#define meltfront_reference_fem_fitted_physics_h

#include <cases/wall_law.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace meltfront::reference_fem::fitted
{
  /** A phase as the weak form sees it: e = latent + capacity (T - T_m). */
  struct Phase
  {
    bool solid = true;
    double conductivity = 1; ///< W/(m K)
    double capacity = 1;     ///< J/(m^3 K)
    double latent = 0;       ///< J/m^3, of the liquid
  };

  /** How time follows from the clock of the integration: t = clock, or t = origin +
   * clock^2. */
  struct Clock
  {
    bool root = false;
    double origin = 0; ///< s

    double time(double clock) const
    {
      return root ? origin + clock * clock : clock;
    }

    /** dt/dclock */
    double rate(double clock) const
    {
      return root ? 2 * clock : 1;
    }

    double clock(double time) const
    {
      return root ? std::sqrt(std::max(time - origin, 0.)) : time;
    }
  };

  /** What holds in the domain and on the two walls that the rays end at. */
  struct Physics
  {
    std::array<Phase, 2> phases; ///< at the inner wall or centre, and beyond the front
    cases::Boundary inner_wall, outer_wall;
    double melting_temperature = 0;
    /** Heat that a source at the centre gives off (W, W/m); empty without one. */
    std::function<double(double time)> power;
    /** Heat released throughout (W/m^3); without a value where there is none. */
    cases::Field volumetric_source;
    /** 1 - rho_solid/rho_liquid: how fast liquid beyond the front moves outward, of the
     * front's speed. */
    double displacement = 0;
    double temperature_scale = 1; ///< K, against which errors are judged
    Clock clock;
  };

  /**
   * The field of a source at the centre in a phase of conductivity k, which is singular
   * there and split off the temperature:
   *
   *   S = -P/(2 pi k) ln(r/R) around an axis, S = P/(4 pi k r) around a point.
   */
  struct SourceField
  {
    int exponent = 0;     ///< of areas r^m: 1 or 2
    double strength = 0;  ///< P/(2 pi k) or P/(4 pi k)
    double reference = 1; ///< R (m)

    static SourceField of(int exponent, double power, double conductivity,
                          double reference)
    {
      using std::numbers::pi;
      return {exponent, power / ((exponent == 1 ? 2 : 4) * pi * conductivity), reference};
    }

    double value(double r) const
    {
      if(strength == 0)
        return 0;
      return exponent == 1 ? -strength * std::log(r / reference) : strength / r;
    }

    double slope(double r) const
    {
      return strength == 0 ? 0 : -strength / (exponent == 1 ? r : r * r);
    }

    double curvature(double r) const
    {
      return strength == 0 ? 0
                           : strength * exponent / (exponent == 1 ? r * r : r * r * r);
    }
  };
} // namespace meltfront::reference_fem::fitted

#endif
