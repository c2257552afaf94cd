// The heat within a box changes by what the walls conduct and the sources release.

#include <cases/exact/manufactured/manufactured_solution.h>
#include <cases/exact/tests/materials.h>

#include <boost/math/quadrature/gauss.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace meltfront::cases::manufactured
{
  namespace
  {
    using Integrand = std::function<double(const Position &)>;

    Material contrasting()
    {
      return {{1, 1, 0.9}, {0.1, 2, 1}, 0.7, 0};
    }

    double gauss(const std::function<double(double)> &f, double lower, double upper)
    {
      return boost::math::quadrature::gauss<double, 80>::integrate(f, lower, upper);
    }

    /** Central, of order eight. */
    double time_derivative(const std::function<double(double)> &f, double time,
                           double step)
    {
      double sum = 0;
      const std::array<double, 4> weights{4. / 5, -1. / 5, 4. / 105, -1. / 280};
      for(int n = 0; n < 4; ++n)
        sum += weights[n] * (f(time + (n + 1) * step) - f(time - (n + 1) * step));
      return sum / step;
    }

    /** Enthalpy per volume above that of solid at the melting temperature. */
    double heat(const ManufacturedSolution &solution, const Material &material,
                const Position &p, double time)
    {
      const bool solid = solution.level_set(p, time) < 0;
      const PhaseProperties &phase = solid ? material.solid : material.liquid;
      return phase.volumetric_heat_capacity()
                 * (solution.temperature(p, time) - material.melting_temperature)
             + (solid ? 0 : material.solid.density * material.latent_heat);
    }

    /** Rate of change and supply of heat. */
    struct Balance
    {
      double change, supply;
    };

    /** Over the disk or ball of radius one. */
    Balance round_balance(const Material &material, int dimension, double time)
    {
      const auto family = make_front_family({"disk", dimension, 1, 1, 3});
      const ManufacturedSolution solution(material, family, 1);
      const Symmetry symmetry
          = dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical;
      const auto surface = [&](double r) {
        return dimension * volume_between(symmetry, 0, 1) * (dimension == 2 ? r : r * r);
      };
      const auto integral = [&](const Integrand &f, double t)
      {
        const double front = -solution.signed_distance({0, 0, 0}, t);
        const auto of_radius = [&](double r) { return surface(r) * f({r, 0, 0}); };
        return gauss(of_radius, 0, front) + gauss(of_radius, front, 1);
      };
      const auto content = [&](double t)
      {
        return integral([&](const Position &p) { return heat(solution, material, p, t); },
                        t);
      };
      const double supply = surface(1) * solution.heat_flux({1, 0, 0}, time)[0]
                            + integral([&](const Position &p)
                                       { return solution.volumetric_source(p, time); },
                                       time);
      return {time_derivative(content, time, 0.005), supply};
    }

    /** Over the disk of radius one, by rays from a place inside a front that each of them
     * crosses once. */
    class Rays
    {
    public:
      Rays(const ManufacturedSolution &solution, const Position &centre, double time)
        : centre(centre)
      {
        for(int n = 0; n < count; ++n)
        {
          const double angle = 2 * std::numbers::pi * n / count;
          Ray ray{std::cos(angle), std::sin(angle), 0, 0};
          const double across = centre[0] * ray.y - centre[1] * ray.x;
          ray.rim
              = std::sqrt(1 - across * across) - centre[0] * ray.x - centre[1] * ray.y;
          double solid = 0, liquid = ray.rim;
          for(int halving = 0; halving < 55; ++halving)
          {
            ray.front = (solid + liquid) / 2;
            (solution.level_set(at(ray, ray.front), time) < 0 ? solid : liquid)
                = ray.front;
          }
          rays.push_back(ray);
        }
      }

      double over_disk(const Integrand &f) const
      {
        return sum(
            [&](const Ray &ray)
            {
              const auto along = [&](double r) { return r * f(at(ray, r)); };
              return gauss(along, 0, ray.front) + gauss(along, ray.front, ray.rim);
            });
      }

      /** f is given per area of front times |grad f|, whose gradient is the second. */
      double over_front(
          const Integrand &f,
          const std::function<std::array<double, 3>(const Position &)> &gradient) const
      {
        return sum(
            [&](const Ray &ray)
            {
              const Position p = at(ray, ray.front);
              const auto slope = gradient(p);
              return ray.front * f(p) / (slope[0] * ray.x + slope[1] * ray.y);
            });
      }

    private:
      struct Ray
      {
        double x, y, rim, front;
      };

      static constexpr int count = 400;
      Position centre;
      std::vector<Ray> rays;

      Position at(const Ray &ray, double r) const
      {
        return {centre[0] + r * ray.x, centre[1] + r * ray.y, 0};
      }

      double sum(const std::function<double(const Ray &)> &f) const
      {
        double total = 0;
        for(const Ray &ray : rays)
          total += f(ray);
        return total * 2 * std::numbers::pi / count;
      }
    };

    /** Change and supply, and what the front's temperature passes from one phase to the
     * other as it moves. */
    std::pair<Balance, double> balance_with_curvature(const char *name, double time)
    {
      Material material = contrasting();
      material.gibbs_thomson_coefficient = 0.05;
      const auto family = make_front_family({name, 2, 1, 1, 3});
      const ManufacturedSolution solution(material, family, 1);
      const Position centre = family->name() == "ellipse"
                                  ? Position{0.6 * time - 0.3, 0.2 * time - 0.1, 0}
                                  : Position{};
      const auto content = [&](double t)
      {
        return Rays(solution, centre, t)
            .over_disk([&](const Position &p) { return heat(solution, material, p, t); });
      };
      const Rays rays(solution, centre, time);
      double supply = rays.over_disk([&](const Position &p)
                                     { return solution.volumetric_source(p, time); });
      for(int n = 0; n < 400; ++n)
      {
        const double angle = std::numbers::pi / 200 * n;
        const Position p{std::cos(angle), std::sin(angle), 0};
        const auto flux = solution.heat_flux(p, time);
        supply += std::numbers::pi / 200 * (flux[0] * p[0] + flux[1] * p[1]);
      }
      const double difference = material.solid.volumetric_heat_capacity()
                                - material.liquid.volumetric_heat_capacity();
      const double passed = rays.over_front(
          [&](const Position &p)
          {
            const FrontDerivatives f = family->derivatives(p, time);
            return difference * material.gibbs_thomson_coefficient * f.curvature()
                   * f.rate;
          },
          [&](const Position &p) { return family->derivatives(p, time).gradient; });
      return {{time_derivative(content, time, 0.002), supply}, passed};
    }

    /** A quarter of the ovals' domain, cut into strips that the front does not enter;
     * lower and upper end of the front's range of x are resolved by x = a + (b - a) sin^2
     * u. */
    double quarter_of_ovals(const Integrand &f, double product)
    {
      const double a = 0.5, width = 1, height = 0.6;
      const double root = std::sqrt(product);
      const double inner = std::sqrt(std::max(0., a * a - root)),
                   outer = std::sqrt(a * a + root);
      const auto half_width = [&](double x)
      {
        const double square = std::sqrt(4 * a * a * x * x + product) - x * x - a * a;
        return std::sqrt(std::max(0., square));
      };
      const auto column = [&](double x, double from, double to) {
        return gauss([&](double y) { return f({x, y, 0}); }, from, to);
      };
      const auto strip = [&](double from, double to, const auto &of_x)
      {
        return gauss(
            [&](double u)
            {
              const double sine = std::sin(u);
              return (to - from) * std::sin(2 * u)
                     * of_x(from + (to - from) * sine * sine);
            },
            0, std::numbers::pi / 2);
      };
      const auto whole = [&](double x) { return column(x, 0, height); };
      const auto cut = [&](double x)
      { return column(x, 0, half_width(x)) + column(x, half_width(x), height); };
      return strip(0, inner, whole) + strip(inner, outer, cut)
             + strip(outer, width, whole);
    }

    Balance ovals_balance(const Material &material, double time)
    {
      const auto family = make_front_family({"two-disks", 2, 1, 1, 3});
      const ManufacturedSolution solution(material, family, 1);
      const auto product = [](double t)
      {
        const double wave = std::cos(2 * std::numbers::pi * t);
        return 0.0625 * (1 - wave * wave * wave / 2);
      };
      const auto content = [&](double t)
      {
        return 4
               * quarter_of_ovals([&](const Position &p)
                                  { return heat(solution, material, p, t); },
                                  product(t));
      };
      const double walls = gauss(
                               [&](double y) {
                                 return solution.heat_flux({1, y, 0}, time)[0];
                               },
                               0, 0.6)
                           + gauss(
                               [&](double x) {
                                 return solution.heat_flux({x, 0.6, 0}, time)[1];
                               },
                               0, 1);
      const double sources = quarter_of_ovals(
          [&](const Position &p) { return solution.volumetric_source(p, time); },
          product(time));
      return {time_derivative(content, time, 0.002), 4 * (walls + sources)};
    }
  } // namespace

  TEST(ManufacturedHeatBalance, OfADiskAndABallOfAnotherDensity)
  {
    const Balance disk = round_balance(contrasting(), 2, 0.1);
    expect_relative(disk.change, -53.7735033250673, 1e-10);
    expect_relative(disk.supply, -53.7735033250673, 1e-13);
    const Balance ball = round_balance(contrasting(), 3, 0.1);
    expect_relative(ball.change, ball.supply, 1e-10);
  }

  TEST(ManufacturedHeatBalance, OfTwoDisksThatMerge)
  {
    const std::vector<std::pair<double, double>> known{
        {0.2, -4.6461926703}, {0.3, -8.4867582061}, {0.4, -24.8054180447}};
    for(const auto &[time, change] : known)
    {
      const Balance balance = ovals_balance(contrasting(), time);
      expect_relative(balance.change, balance.supply, 1e-10);
      expect_relative(balance.supply, change, 1e-10);
    }
  }

  /** The enthalpies of the phases change with the front's temperature at different rates,
   * while the latent heat is kept: what passes from one to the other brings or takes the
   * difference. */
  TEST(ManufacturedHeatBalance, WithTheCurvaturesMeltingTemperature)
  {
    Material material = contrasting();
    material.gibbs_thomson_coefficient = 0.05;
    const double time = 0.1;
    const Balance balance = round_balance(material, 2, time);
    const auto family = make_front_family({"disk", 2, 1, 1, 3});
    const double undercooling = -0.05 * family->uniform_curvature(time)->value;
    const double growth
        = time_derivative([&](double t) { return family->solid_volume(t); }, time, 0.005);
    const double passed = (material.solid.volumetric_heat_capacity()
                           - material.liquid.volumetric_heat_capacity())
                          * undercooling * growth;
    EXPECT_NEAR(balance.change, balance.supply + passed, 1e-9);
    EXPECT_NEAR(balance.change - balance.supply, 0.263494363, 2e-9);

    const ManufacturedSolution solution(material, family, 1);
    const double radius = -family->signed_distance({0, 0, 0}, time);
    EXPECT_NEAR(solution.temperature({radius, 0, 0}, time), undercooling, 1e-14);
  }

  TEST(ManufacturedHeatBalance, WithACurvatureThatVariesAlongTheFront)
  {
    for(const char *name : {"ellipse", "star-3"})
    {
      const auto [balance, passed] = balance_with_curvature(name, 0.3);
      expect_relative(balance.change, balance.supply + passed, 1e-9);
      EXPECT_GT(std::abs(passed), 1e-3) << name;
    }
  }
} // namespace meltfront::cases::manufactured
