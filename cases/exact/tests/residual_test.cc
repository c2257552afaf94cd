// The similarity profiles against the equations they are to solve, with fifty digits.

#include <cases/exact/profiles.h>
#include <cases/exact/tests/materials.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace meltfront::cases
{
  namespace
  {
    using Real = boost::multiprecision::cpp_bin_float_50;
    using similarity::Phase;
    using similarity::PlanarProfile;
    using similarity::RadialProfile;
    using Field = std::function<Real(const Real &coordinate, const Real &time)>;

    /** Differences with this relative step are exact to about its square. */
    const Real step = 1e-11;
    const double allowed = 1e-18;
    /** Surely on one side of the front. */
    const Real hair = 1e-40;

    Real first_derivative(const std::function<Real(const Real &)> &f, const Real &x)
    {
      const Real h = step * x;
      return (f(x + h) - f(x - h)) / (2 * h);
    }

    /** One-sided, second order; the side is that of `direction`. */
    Real one_sided_derivative(const std::function<Real(const Real &)> &f, const Real &x,
                              int direction)
    {
      const Real h = direction * step * x;
      return (-3 * f(x) + 4 * f(x + h) - f(x + 2 * h)) / (2 * h);
    }

    /** T_t + velocity T_r - a (T_rr + m/r T_r), relative to its largest term. */
    double heat_residual(const Field &temperature, const Real &r, const Real &time,
                         const Real &diffusivity, int exponent, const Real &velocity)
    {
      const auto in_space = [&](const Real &x) { return temperature(x, time); };
      const auto in_time = [&](const Real &t) { return temperature(r, t); };
      const Real h = step * r;
      const Real rate = first_derivative(in_time, time);
      const Real slope = first_derivative(in_space, r);
      const Real curvature
          = (in_space(r + h) - 2 * in_space(r) + in_space(r - h)) / (h * h);
      const Real conduction = diffusivity * (curvature + exponent * slope / r);
      const Real residual = rate + velocity * slope - conduction;
      const Real magnitude = std::max<Real>(abs(rate), diffusivity * abs(slope) / r);
      return static_cast<double>(abs(residual) / magnitude);
    }

    /** rho_near L ds/dt -+ [k dT/dr], relative to the latent heat. */
    double stefan_residual(const Field &temperature,
                           const std::function<Real(const Real &)> &front,
                           const Real &time, const Phase<Real> &near,
                           const Phase<Real> &far, const Real &latent_heat, int sign)
    {
      const Real s = front(time);
      const auto in_space = [&](const Real &x) { return temperature(x, time); };
      const Real latent = near.density * latent_heat * first_derivative(front, time);
      const Real flux
          = near.conductivity * one_sided_derivative(in_space, s * (1 - hair), -1)
            - far.conductivity * one_sided_derivative(in_space, s * (1 + hair), 1);
      return static_cast<double>(abs(latent - sign * flux) / latent);
    }

    void check_planar(const Material &material, double wall, double distant,
                      const Real &time)
    {
      const PlanarProfile<Real> profile(material, wall, distant);
      const Field temperature
          = [&](const Real &x, const Real &t) { return profile.temperature(x, t); };
      const auto front = [&](const Real &t) { return profile.front(t); };
      const Real s = front(time);
      const int sign = profile.solid_is_near ? 1 : -1;
      const Real displacement
          = (1 - profile.density_ratio) * first_derivative(front, time);

      for(const double share : {0.1, 0.5, 0.9})
        EXPECT_LT(
            heat_residual(temperature, share * s, time, profile.near.diffusivity, 0, 0),
            allowed);
      if(distant != material.melting_temperature)
      {
        for(const double share : {1.1, 1.5, 3.})
          EXPECT_LT(heat_residual(temperature, share * s, time, profile.far.diffusivity,
                                  0, displacement),
                    allowed);
      }
      EXPECT_LT(stefan_residual(temperature, front, time, profile.near, profile.far,
                                profile.latent_heat, sign),
                allowed);
      EXPECT_LT(abs(temperature(s * (1 - hair), time) - material.melting_temperature),
                1e-30);
      EXPECT_LT(abs(temperature(s * (1 + hair), time) - material.melting_temperature),
                1e-30);
      EXPECT_EQ(temperature(0, time), wall);
      EXPECT_LT(abs(temperature(1000 * s, time) - distant), 1e-30);
    }

    void check_radial(const RadialProfile<Real> &profile, const Real &time)
    {
      const Field temperature
          = [&](const Real &r, const Real &t) { return profile.temperature(r, t); };
      const auto front = [&](const Real &t) { return profile.front(t); };
      const Real s = front(time);
      const int exponent = profile.dimension - 1;
      if(profile.amplitude != 0)
      {
        for(const double share : {0.1, 0.5, 0.9})
          EXPECT_LT(heat_residual(temperature, share * s, time, profile.solid.diffusivity,
                                  exponent, 0),
                    allowed);
      }
      // Where the excess is still far above the fifty digits of the far temperature.
      const Real z = profile.front_in_liquid();
      if(profile.distant != profile.melting)
      {
        for(const double beyond : {0.01, 1., 15.})
          EXPECT_LT(heat_residual(temperature, s * sqrt(1 + beyond / z), time,
                                  profile.liquid.diffusivity, exponent, 0),
                    allowed);
      }
      EXPECT_LT(stefan_residual(temperature, front, time, profile.solid, profile.liquid,
                                profile.latent_heat, 1),
                allowed);
      EXPECT_LT(abs(temperature(s * (1 - hair), time) - profile.melting), 1e-30);
      EXPECT_LT(abs(temperature(s * (1 + hair), time) - profile.melting), 1e-30);
    }

    /** Heat drawn at the origin: the flux through a surface that shrinks onto it. */
    Real drawn_heat(const RadialProfile<Real> &profile, const Real &time)
    {
      const auto in_space = [&](const Real &r) { return profile.temperature(r, time); };
      const Real r = profile.front(time) * Real(1e-12);
      const Real pi = boost::math::constants::pi<Real>();
      const Real area = profile.dimension == 2 ? 2 * pi * r : 4 * pi * r * r;
      return area * profile.solid.conductivity * first_derivative(in_space, r);
    }
  } // namespace

  TEST(FiftyDigits, PlanarNeumannSolvesTheStefanProblem)
  {
    check_planar(unit_material(), unit_wall, 1.2, 0.0568);
    check_planar(water(), -10, 10, 86400);
    check_planar(water(917), -10, 10, 86400);
    check_planar(water(), -10, 0, 86400);
    check_planar({{1, 1, 1}, {0.1, 2, 1}, 1, 0}, -1, 0.5, 0.1);
    check_planar(water(917), 10, -10, 86400);
    check_planar(water(), 40, 0, 86400);
  }

  TEST(FiftyDigits, SinksSolveTheStefanProblem)
  {
    for(const int dimension : {2, 3})
      for(const double lambda : {0.01, 0.15, 1.})
        for(const double distant : {0., 10.})
          check_radial(RadialProfile<Real>::sink(dimension, water(), lambda, distant),
                       475000);
  }

  TEST(FiftyDigits, FrankSolvesTheStefanProblem)
  {
    for(const int dimension : {1, 2, 3})
      for(const double undercooling : {0.01, 0.5, 0.95})
        check_radial(
            RadialProfile<Real>::growth(dimension, unit_material(), 1 - undercooling), 2);
  }

  TEST(FiftyDigits, StrengthOfTheSinks)
  {
    const auto line = RadialProfile<Real>::sink(2, water(), Real(15) / 100, 10);
    EXPECT_LT(abs(drawn_heat(line, 475000) / Real(148.4508990290751) - 1), 1e-15);
    const auto point = RadialProfile<Real>::sink(3, water(), Real(15) / 100, 10);
    EXPECT_LT(abs(drawn_heat(point, 400) / 20 / Real(0.107715116113955) - 1), 5e-15);
  }

  TEST(FiftyDigits, ScaledGammaFunctionsMeetAtTheSwitch)
  {
    for(const int dimension : {1, 2, 3})
    {
      const Real below = Real(2) - Real(1e-40), above = 2;
      EXPECT_LT(abs(similarity::scaled_upper_gamma(dimension, below)
                        / similarity::scaled_upper_gamma(dimension, above)
                    - 1),
                1e-38);
      for(const double z : {1e-12, 1e-3, 0.5, 1.999, 2., 2.5, 10., 700., 1e9})
        EXPECT_LT(abs(similarity::scaled_upper_gamma(dimension, z)
                          / similarity::scaled_upper_gamma(dimension, Real(z))
                      - 1),
                  4e-15)
            << dimension << " " << z;
    }
  }

  /** Doubles against fifty digits over eighteen decades of contrast and six of Stefan
   * number: a bracket that misses the root, or terms that overflow, would show. */
  TEST(FiftyDigits, FrontConstantIsRobust)
  {
    for(const double contrast : {1e-9, 1e-6, 1e-3, 1., 1e3, 1e6, 1e9})
      for(const double stefan : {1e-3, 1e-2, 0.1, 1., 10., 100., 1e3})
        for(const double superheat : {0., 0.3, 30.})
        {
          const Material material{{1, 1, 1}, {contrast, 1, 1}, 1, 0};
          const PlanarProfile<double> rounded(material, -stefan, superheat * stefan);
          const PlanarProfile<Real> precise(material, -stefan, superheat * stefan);
          EXPECT_LT(abs(rounded.lambda / precise.lambda - 1), 1e-13)
              << contrast << " " << stefan << " " << superheat;
          for(const double share : {0.2, 0.99, 1.01, 1.5})
          {
            const double x = share * rounded.front(1);
            EXPECT_LT(abs(rounded.temperature(x, 1) - precise.temperature(x, 1)),
                      1e-13 * stefan * std::max(1., superheat))
                << contrast << " " << stefan << " " << superheat << " " << share;
          }
        }
  }

  TEST(FiftyDigits, SinksAreRobust)
  {
    for(const int dimension : {2, 3})
      for(const double contrast : {1e-9, 1e-3, 1., 1e3, 1e9})
        for(const double lambda : {1e-4, 0.15, 3.})
        {
          const Material material{{1, 1, 1}, {contrast, 1, 1}, 1, 0};
          const auto rounded
              = RadialProfile<double>::sink(dimension, material, lambda, 1);
          const auto precise = RadialProfile<Real>::sink(dimension, material, lambda, 1);
          EXPECT_LT(abs(rounded.amplitude / precise.amplitude - 1), 1e-13)
              << dimension << " " << contrast << " " << lambda;
          for(const double share : {1.0001, 1.5, 30.})
          {
            const double r = share * rounded.front(1);
            EXPECT_LT(abs(rounded.temperature(r, 1) - precise.temperature(r, 1)), 1e-13)
                << dimension << " " << contrast << " " << lambda << " " << share;
          }
        }
  }
} // namespace meltfront::cases
