// Areas and volumes of the solid of each family, in closed form as far as there is one.

#include <cases/exact/manufactured/formulas.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace meltfront::cases::manufactured
{
  namespace
  {
    using std::numbers::pi;

    /** Of the finger; negative where there is none. */
    double square_of_half_width(double x, double neck)
    {
      return x * x * (0.5 - x / 1.2) + neck;
    }

    double closed_root(double neck, double lower, double upper)
    {
      const auto f = [neck](double x) { return square_of_half_width(x, neck); };
      std::uintmax_t iterations = 100;
      const auto closed
          = [](double a, double b) { return std::abs(a - b) <= 1e-16 * std::abs(b); };
      const auto [left, right]
          = boost::math::tools::toms748_solve(f, lower, upper, closed, iterations);
      return (left + right) / 2;
    }

    /** Where the finger has a width: from its base to its tip, whole or in two. */
    std::vector<std::pair<double, double>> pieces_of_finger(double neck)
    {
      const double base = Finger::lower[0], fattest = 0.4;
      const double tip = closed_root(neck, fattest, Finger::upper[0]);
      if(neck >= 0)
        return {{base, 0}, {0, tip}};
      return {{base, closed_root(neck, base, 0)}, {closed_root(neck, 0, fattest), tip}};
    }

    /** Integral of the square of the half width from 0 to x. */
    double squares_below(double x, double neck)
    {
      return x * (x * x * (1. / 6 - x / 4.8) + neck);
    }
  } // namespace

  double Plane::solid_volume(double tau, int) const
  {
    return place(tau);
  }

  double Disk::solid_volume(double tau, int dimension) const
  {
    const double r = radius(tau);
    return dimension == 2 ? pi * r * r : 4. / 3 * pi * r * r * r;
  }

  double Star::solid_volume(double tau, int) const
  {
    return area_over_square_of_radius * square(radius(tau));
  }

  double Ellipse::solid_volume(double tau, int dimension) const
  {
    const auto axes = half_axes(tau);
    const double area = pi * axes[0] * axes[1];
    return dimension == 2 ? area : 4. / 3 * area * axes[2];
  }

  double TwoDisks::solid_volume(double tau, int dimension) const
  {
    using boost::math::ellint_1, boost::math::ellint_2;
    const double a = place, at_contact = a * a * a * a, c = at_contact - gap(tau);
    const double root = std::sqrt(c);
    if(dimension == 3)
    {
      // The square of the half width is sqrt(4 a^2 x^2 + c) - x^2 - a^2.
      const auto below = [&](double x)
      {
        return x / 2 * std::sqrt(4 * a * a * x * x + c)
               + c / (4 * a) * std::asinh(2 * a * x / root) - x * (x * x / 3 + a * a);
      };
      const double inner = std::sqrt(std::max(0., a * a - root));
      return 2 * pi * (below(std::sqrt(a * a + root)) - below(inner));
    }
    if(c == at_contact)
      return 2 * a * a;
    if(c > at_contact)
      return 2 * root * ellint_2(a * a / root);
    const double modulus = root / (a * a);
    return 2 * a * a * (ellint_2(modulus) - (1 - modulus * modulus) * ellint_1(modulus));
  }

  double Finger::solid_volume(double tau, int dimension) const
  {
    const double c = neck(tau);
    boost::math::quadrature::tanh_sinh<double> integrator;
    double sum = 0;
    for(const auto &[from, to] : pieces_of_finger(c))
      if(dimension == 3)
        sum += pi * (squares_below(to, c) - squares_below(from, c));
      else if(from < to)
        sum += 2
               * integrator.integrate(
                   [c](double x)
                   { return std::sqrt(std::max(0., square_of_half_width(x, c))); },
                   from, to);
    return sum;
  }
} // namespace meltfront::cases::manufactured
