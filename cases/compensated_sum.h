#ifndef meltfront_cases_compensated_sum_h
#define meltfront_cases_compensated_sum_h

#include <cmath>

namespace meltfront::cases
{
  /** A sum of doubles that keeps the rounding error of every addition (Knuth 1969,
   * TwoSum). */
  class CompensatedSum
  {
  public:
    void add(double term)
    {
      const double next = sum + term;
      const double part = next - sum;
      error += (sum - (next - part)) + (term - part);
      sum = next;
    }

    /** Add the product of two numbers with its own rounding error. */
    void add_product(double a, double b)
    {
      const double product = a * b;
      error += std::fma(a, b, -product);
      add(product);
    }

    double value() const
    {
      return sum + error;
    }

    /** The sum in extended precision, where there is one. */
    long double extended() const
    {
      return static_cast<long double>(sum) + error;
    }

  private:
    double sum = 0, error = 0;
  };
} // namespace meltfront::cases

#endif
