#ifndef meltfront_particles_greenspan_motion_pair_powers_h
#define meltfront_particles_greenspan_motion_pair_powers_h

#include <particles/greenspan/motion/pair_force.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  /** x^n by squaring, unrolled by the compiler. */
  template <int n>
  inline double integer_power(double x)
  {
    static_assert(n >= 0);
    if constexpr(n == 0)
      return 1;
    else if constexpr(n == 1)
      return x;
    else if constexpr(n % 2 == 1)
      return integer_power<n - 1>(x) * x;
    else
      return integer_power<n / 2>(x) * integer_power<n / 2>(x);
  }

  /** f(r) / r with the exponents compiled in: one division, one root, products. */
  template <int alpha, int beta>
  class CompiledPowers
  {
  public:
    explicit CompiledPowers(const PairForce &force)
      : attraction(force.attraction)
      , repulsion(force.repulsion)
    {
    }

    double operator()(double squared_distance) const
    {
      const double square = 1 / squared_distance;
      const double root = std::sqrt(square);
      return power<beta + 1>(square, root)
             * (repulsion * power<alpha - beta>(square, root) - attraction);
    }

  private:
    /** 1 / r^n */
    template <int n>
    static double power(double square, double root)
    {
      if constexpr(n % 2 == 0)
        return integer_power<n / 2>(square);
      else
        return integer_power<n / 2>(square) * root;
    }

    double attraction, repulsion;
  };

  /** f(r) / r of a force that is shifted to zero at its cutoff. */
  template <typename Powers>
  class ShiftedPowers
  {
  public:
    explicit ShiftedPowers(const PairForce &force)
      : powers(force)
      , shift(force.shift())
    {
    }

    double operator()(double squared_distance) const
    {
      return powers(squared_distance) - shift / std::sqrt(squared_distance);
    }

  private:
    Powers powers;
    double shift;
  };

  /** f(r) / r with any exponents. */
  class GeneralPowers
  {
  public:
    explicit GeneralPowers(const PairForce &force)
      : attraction(force.attraction)
      , repulsion(force.repulsion)
      , outer(-(force.attraction_exponent + 1) / 2)
      , inner(-(force.repulsion_exponent - force.attraction_exponent) / 2)
    {
    }

    double operator()(double squared_distance) const
    {
      return std::pow(squared_distance, outer)
             * (repulsion * std::pow(squared_distance, inner) - attraction);
    }

  private:
    double attraction, repulsion, outer, inner;
  };
} // namespace meltfront::particles::greenspan

#endif
