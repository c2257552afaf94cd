#ifndef meltfront_cases_exact_root_h
#define meltfront_cases_exact_root_h

#include <cases/error.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace meltfront::cases::similarity
{
  /** The two sides of an equation at a trial value. */
  template <typename Real>
  struct Balance
  {
    Real residual;  ///< left minus right; must fall through zero as the unknown grows
    Real magnitude; ///< largest of the terms, the measure of the residual
  };

  /**
   * The positive root of an equation whose residual decreases from positive to negative.
   *
   * The bracket is found by doubling or halving from 1 until the sign changes, whatever
   * the decade of the root, then closed to the last bits (Alefeld, Potra and Shi 1995).
   *
   * @param balance  function of a Real that returns a Balance<Real>
   * @param what     names the equation in messages
   * @throws NumericalError where there is no sign change within the range of numbers, or
   * where the residual at the root exceeds 1e-14 of the largest term.
   */
  template <typename Real, typename Function>
  Real decreasing_root(const Function &balance, const std::string &what)
  {
    using std::abs, std::sqrt;
    const auto residual = [&](const Real &x) { return balance(x).residual; };
    const auto give_up = [&](const std::string &problem)
    { throw NumericalError("similarity solution", 0, 0, what, problem); };

    Real lower = 1, upper = 1;
    const int most_halvings = 1000;
    int count = 0;
    for(; !(residual(upper) <= 0) && count < most_halvings; ++count)
      upper *= 2;
    lower = count > 0 ? upper / 2 : lower;
    for(; count < most_halvings && !(residual(lower) >= 0); ++count)
    {
      upper = lower;
      lower /= 2;
    }
    if(count >= most_halvings)
      give_up("has no root that can be bracketed");

    std::uintmax_t iterations = 500;
    const auto closed = [](const Real &a, const Real &b)
    { return abs(a - b) <= std::numeric_limits<Real>::epsilon() * b; };
    const auto bracket
        = boost::math::tools::toms748_solve(residual, lower, upper, closed, iterations);
    const Balance<Real> left = balance(bracket.first), right = balance(bracket.second);
    const bool left_is_better = abs(left.residual) <= abs(right.residual);
    const Balance<Real> &best = left_is_better ? left : right;
    if(!(abs(best.residual) <= 1e-14 * best.magnitude))
      give_up("leaves a residual above round-off at its root");
    return left_is_better ? bracket.first : bracket.second;
  }
} // namespace meltfront::cases::similarity

#endif
