#ifndef meltfront_particles_sph_two_population_dual_number_h
#define meltfront_particles_sph_two_population_dual_number_h

#include <array>
#include <cmath>
#include <cstddef>

namespace meltfront::particles
{
  /**
   * A value with its derivatives by two variables: formulas written for any number give
   * their derivatives with it (forward automatic differentiation, Wengert 1964).
   */
  struct DualNumber
  {
    DualNumber(double value = 0, std::array<double, 2> slope = {0, 0})
      : value(value)
      , slope(slope)
    {
    }

    double value;
    std::array<double, 2> slope;

    /** A function of this one, given its value and its derivative. */
    DualNumber chain(double result, double derivative) const
    {
      return {result, {derivative * slope[0], derivative * slope[1]}};
    }

    DualNumber operator-() const
    {
      return chain(-value, -1);
    }

    DualNumber &operator+=(const DualNumber &other)
    {
      value += other.value;
      for(std::size_t i = 0; i < slope.size(); ++i)
        slope[i] += other.slope[i];
      return *this;
    }

    DualNumber &operator-=(const DualNumber &other)
    {
      return *this += -other;
    }
  };

  inline DualNumber operator+(DualNumber a, const DualNumber &b)
  {
    return a += b;
  }

  inline DualNumber operator-(DualNumber a, const DualNumber &b)
  {
    return a -= b;
  }

  inline DualNumber operator*(const DualNumber &a, const DualNumber &b)
  {
    return {a.value * b.value,
            {a.slope[0] * b.value + a.value * b.slope[0],
             a.slope[1] * b.value + a.value * b.slope[1]}};
  }

  inline DualNumber operator/(const DualNumber &a, const DualNumber &b)
  {
    const double quotient = a.value / b.value;
    return {quotient,
            {(a.slope[0] - quotient * b.slope[0]) / b.value,
             (a.slope[1] - quotient * b.slope[1]) / b.value}};
  }

  inline DualNumber sqrt(const DualNumber &a)
  {
    const double root = std::sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }

  inline double value_of(double number)
  {
    return number;
  }

  inline double value_of(const DualNumber &number)
  {
    return number.value;
  }

  /** A number of given value that follows another one with a given derivative. */
  inline double follow_number(double value, double, double)
  {
    return value;
  }

  inline DualNumber follow_number(double value, double derivative,
                                  const DualNumber &other)
  {
    return other.chain(value, derivative);
  }
} // namespace meltfront::particles

#endif
