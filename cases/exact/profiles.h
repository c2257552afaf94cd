#ifndef meltfront_cases_exact_profiles_h
#define meltfront_cases_exact_profiles_h

#include <cases/exact/root.h>
#include <cases/exact/special_functions.h>
#include <cases/material.h>

#include <boost/math/constants/constants.hpp>

#include <algorithm>
#include <cmath>

/**
 * The similarity profiles themselves, for any number type: what the public classes
 * evaluate in double, and what the tests differentiate with fifty digits.
 */
namespace meltfront::cases::similarity
{
  /** Properties of one phase as numbers of type Real. */
  template <typename Real>
  struct Phase
  {
    explicit Phase(const PhaseProperties &properties)
      : conductivity(properties.conductivity)
      , density(properties.density)
      , diffusivity(conductivity / (density * Real(properties.specific_heat_capacity)))
    {
    }

    Real conductivity; ///< W/(m K)
    Real density;      ///< kg/m^3
    Real diffusivity;  ///< m^2/s
  };

  /**
   * Neumann's solution (c. 1860; Carslaw and Jaeger 1959, 11.2) for a half space whose
   * wall is held at a temperature, with the displacement of the far phase where the
   * densities differ.
   *
   * `near` is the phase at the wall, at rest; `far` moves with (1 - r) ds/dt, r =
   * rho_near / rho_far. With nu = sqrt(a_near/a_far) and s = 2 lambda sqrt(a_near t),
   * lambda solves
   *
   *   k_near |T_m - T_wall| e^(-lambda^2) / (sqrt(pi a_near) erf lambda)
   *     - k_far |T_far - T_m| e^(-(r lambda nu)^2) / (sqrt(pi a_far) erfc(r lambda nu))
   *     = rho_near L lambda sqrt(a_near).
   */
  template <typename Real>
  class PlanarProfile
  {
  public:
    PlanarProfile(const Material &material, double wall_temperature,
                  double far_temperature)
      : solid_is_near(wall_temperature < material.melting_temperature)
      , near(solid_is_near ? material.solid : material.liquid)
      , far(solid_is_near ? material.liquid : material.solid)
      , wall(wall_temperature)
      , distant(far_temperature)
      , melting(material.melting_temperature)
      , latent_heat(material.latent_heat)
      , density_ratio(near.density / far.density)
    {
      using std::sqrt;
      diffusivity_root = sqrt(near.diffusivity / far.diffusivity);
      lambda = decreasing_root<Real>([this](const Real &x) { return balance(x); },
                                     "the front constant lambda");
    }

    Real front(const Real &time) const
    {
      using std::sqrt;
      return 2 * lambda * sqrt(near.diffusivity * time);
    }

    Real temperature(const Real &x, const Real &time) const
    {
      using std::sqrt;
      if(time <= 0)
        return x > 0 ? distant : wall;
      const Real scaled = x / (2 * sqrt(near.diffusivity * time));
      if(scaled <= lambda)
        return wall
               + (melting - wall) * boost::math::erf(scaled) / boost::math::erf(lambda);
      const Real at_front = density_ratio * lambda * diffusivity_root;
      const Real beyond = (scaled - lambda) * diffusivity_root + at_front;
      return distant
             + (melting - distant)
                   * upper_gamma_ratio<Real>(1, beyond * beyond, at_front * at_front);
    }

    /** The Stefan condition at the front for a trial lambda, times sqrt(t). */
    Balance<Real> balance(const Real &x) const
    {
      using std::abs, std::exp, std::max, std::sqrt;
      const Real root_pi = sqrt(boost::math::constants::pi<Real>());
      const Real inflow = near.conductivity * abs(melting - wall) * exp(-x * x)
                          / (root_pi * sqrt(near.diffusivity) * boost::math::erf(x));
      const Real at_front = density_ratio * x * diffusivity_root;
      const Real outflow
          = far.conductivity * abs(distant - melting)
            / (sqrt(far.diffusivity) * scaled_upper_gamma<Real>(1, at_front * at_front));
      const Real latent = near.density * latent_heat * x * sqrt(near.diffusivity);
      return {inflow - outflow - latent, max(inflow, max(outflow, latent))};
    }

    bool solid_is_near;
    Phase<Real> near, far;
    Real wall, distant, melting;
    Real latent_heat;
    Real density_ratio;    ///< r
    Real diffusivity_root; ///< nu
    Real lambda;
  };

  /**
   * Freezing from a line or point sink at r = 0, or growth into undercooled melt (Frank
   * 1950), in d dimensions. With zeta_i = r^2/(4 a_i t), z = lambda^2 a_s/a_l and the
   * upper incomplete gamma function G(zeta) = Gamma(1 - d/2, zeta):
   *
   *   T_s = T_m + A [G(lambda^2) - G(zeta_s)],
   *   T_l = T_far - (T_far - T_m) G(zeta_l)/G(z),   front 2 lambda sqrt(a_s t).
   *
   * Every pair (A, lambda) that meets the Stefan condition is a solution; A = 0 is
   * Frank's. (G = E1 in two dimensions and 4 F3 in three: Monaghan, Huppert and Worster
   * 2005, equations 3.7-3.10, corrected: see the README.)
   */
  template <typename Real>
  class RadialProfile
  {
  public:
    /** The sink that drives the front with a given lambda: its A from the Stefan
     * condition. */
    static RadialProfile sink(int dimension, const Material &material, const Real &lambda,
                              double far_temperature)
    {
      using std::exp, std::pow, std::sqrt;
      RadialProfile profile(dimension, material, far_temperature);
      profile.lambda = lambda;
      const Real heat = profile.latent_flux() + profile.liquid_flux();
      profile.amplitude = heat * exp(lambda * lambda) * pow(lambda, dimension - 1)
                          * sqrt(profile.solid.diffusivity) / profile.solid.conductivity;
      return profile;
    }

    /** Growth without a sink: lambda from z^(d/2) e^z G(z) = c_l (T_m - T_far)/L. */
    static RadialProfile growth(int dimension, const Material &material,
                                double far_temperature)
    {
      using std::max, std::pow, std::sqrt;
      RadialProfile profile(dimension, material, far_temperature);
      const Real undercooling = Real(material.liquid.specific_heat_capacity)
                                * (profile.melting - profile.distant)
                                / profile.latent_heat;
      const Real z = decreasing_root<Real>(
          [&](const Real &x) -> Balance<Real>
          {
            const Real grown
                = pow(x, Real(dimension) / 2) * scaled_upper_gamma<Real>(dimension, x);
            return {undercooling - grown, max(undercooling, grown)};
          },
          "the growth constant of Frank's solution");
      profile.lambda = sqrt(z * profile.liquid.diffusivity / profile.solid.diffusivity);
      return profile;
    }

    Real front(const Real &time) const
    {
      using std::sqrt;
      return 2 * lambda * sqrt(solid.diffusivity * time);
    }

    Real temperature(const Real &r, const Real &time) const
    {
      using std::exp;
      if(time <= 0)
        return distant;
      const Real zeta = r * r / (4 * solid.diffusivity * time);
      if(zeta <= lambda * lambda)
      {
        if(amplitude == 0)
          return melting;
        if(zeta == 0)
          return -std::numeric_limits<Real>::infinity();
        const Real z = lambda * lambda;
        return melting
               + amplitude
                     * (exp(-z) * scaled_upper_gamma<Real>(dimension, z)
                        - exp(-zeta) * scaled_upper_gamma<Real>(dimension, zeta));
      }
      return distant
             + (melting - distant)
                   * upper_gamma_ratio<Real>(dimension,
                                             r * r / (4 * liquid.diffusivity * time),
                                             front_in_liquid());
    }

    /** z = lambda^2 a_s/a_l. */
    Real front_in_liquid() const
    {
      return lambda * lambda * solid.diffusivity / liquid.diffusivity;
    }

    /** rho L ds/dt times sqrt(t), W s^(1/2)/m^2. */
    Real latent_flux() const
    {
      using std::sqrt;
      return solid.density * latent_heat * lambda * sqrt(solid.diffusivity);
    }

    /** k_l dT_l/dr at the front times sqrt(t), W s^(1/2)/m^2. */
    Real liquid_flux() const
    {
      using std::pow, std::sqrt;
      const Real z = front_in_liquid();
      return liquid.conductivity * (distant - melting) * lambda * sqrt(solid.diffusivity)
             / (liquid.diffusivity * pow(z, Real(dimension) / 2)
                * scaled_upper_gamma<Real>(dimension, z));
    }

    int dimension;
    Phase<Real> solid, liquid;
    Real distant, melting;
    Real latent_heat;
    Real lambda = 0;
    Real amplitude = 0; ///< A (K)

  private:
    RadialProfile(int dimension, const Material &material, double far_temperature)
      : dimension(dimension)
      , solid(material.solid)
      , liquid(material.liquid)
      , distant(far_temperature)
      , melting(material.melting_temperature)
      , latent_heat(material.latent_heat)
    {
    }
  };
} // namespace meltfront::cases::similarity

#endif
