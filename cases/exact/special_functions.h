#ifndef meltfront_cases_exact_special_functions_h
#define meltfront_cases_exact_special_functions_h

#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/expint.hpp>
#include <boost/math/tools/fraction.hpp>

#include <cmath>
#include <limits>
#include <utility>

/**
 * Functions of the similarity solutions in forms that neither overflow nor vanish, for
 * double and for the numbers of Boost.Multiprecision alike.
 */
namespace meltfront::cases::similarity
{
  /** Legendre's continued fraction of the upper incomplete gamma function: gives the
   * pairs that boost::math::tools::continued_fraction_b asks for. */
  template <typename Real>
  class UpperGammaFraction
  {
  public:
    using result_type = std::pair<Real, Real>;

    UpperGammaFraction(Real a, Real z)
      : a(a)
      , b(z + 1 - a)
    {
    }

    result_type operator()()
    {
      const result_type term(k * (a - k), b);
      b += 2;
      ++k;
      return term;
    }

  private:
    Real a, b;
    int k = 0;
  };

  /**
   * e^z Gamma(1 - d/2, z) for z > 0 and d = 1, 2, 3 dimensions: sqrt(pi) e^z erfc(sqrt
   * z), e^z E1(z), and 4 e^z F3(2 sqrt z) with Frank's F3(s) = e^(-s^2/4)/s - sqrt(pi)/2
   * erfc(s/2). By the definitions for small arguments, by the continued fraction
   * (Abramowitz and Stegun 1964, 6.5.31) from z = 2 on.
   */
  template <typename Real>
  Real scaled_upper_gamma(int dimension, const Real &z)
  {
    using std::exp, std::pow, std::sqrt;
    if(z >= 2)
    {
      const Real a = 1 - Real(dimension) / 2;
      UpperGammaFraction<Real> fraction(a, z);
      return pow(z, a)
             / boost::math::tools::continued_fraction_b(
                 fraction, std::numeric_limits<Real>::epsilon());
    }
    if(dimension == 2)
      return exp(z) * boost::math::expint(1u, z);
    const Real root = sqrt(z);
    const Real scaled_erfc
        = sqrt(boost::math::constants::pi<Real>()) * exp(z) * boost::math::erfc(root);
    return dimension == 1 ? scaled_erfc : 2 / root - 2 * scaled_erfc;
  }

  /** Gamma(1 - d/2, z) / Gamma(1 - d/2, reference), also where both underflow. */
  template <typename Real>
  Real upper_gamma_ratio(int dimension, const Real &z, const Real &reference)
  {
    using std::exp;
    return exp(reference - z) * scaled_upper_gamma(dimension, z)
           / scaled_upper_gamma(dimension, reference);
  }
} // namespace meltfront::cases::similarity

#endif
