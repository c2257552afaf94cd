#ifndef meltfront_reference_fem_enthalpy_compensated_vector_h
#define meltfront_reference_fem_enthalpy_compensated_vector_h

#include <cases/compensated_sum.h>

#include <array>
#include <cstddef>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Numbers stored as the unevaluated sum of two doubles, so that the difference of two
   * neighbours keeps full relative accuracy.
   *
   * Why: a step multiplies differences of u by dt k/(rho c h^2), up to 1e11 where one
   * phase conducts 1e9 times better than the other. Rounding u to a double would then be
   * felt in the enthalpy's fifth digit.
   */
  class CompensatedVector
  {
  public:
    explicit CompensatedVector(std::size_t size = 0)
      : leading(size)
      , remainder(size)
    {
    }

    std::size_t size() const
    {
      return leading.size();
    }

    /** The value rounded to a double; its sign is that of the value. */
    double operator[](std::size_t i) const
    {
      return leading[i];
    }

    /** All of them. */
    const std::vector<double> &rounded() const
    {
      return leading;
    }

    void set(std::size_t i, double value)
    {
      leading[i] = value;
      remainder[i] = 0;
    }

    /** The rounded values and what they leave, which processes exchange. */
    std::array<std::vector<double> *, 2> parts()
    {
      return {&leading, &remainder};
    }

    /** Add with the rounding error kept (Knuth 1969, TwoSum). */
    void add(std::size_t i, double increment)
    {
      increment += remainder[i];
      const double sum = leading[i] + increment;
      const double part = sum - leading[i];
      remainder[i] = (leading[i] - (sum - part)) + (increment - part);
      leading[i] = sum;
    }

    /** Value j less value i. */
    double difference(std::size_t j, std::size_t i) const
    {
      return (leading[j] - leading[i]) + (remainder[j] - remainder[i]);
    }

    /** Add factor times (value j less value i) to a sum, nothing rounded off. */
    void add_difference(std::size_t j, std::size_t i, double factor,
                        cases::CompensatedSum &sum) const
    {
      const double difference = leading[j] - leading[i];
      const double part = difference - leading[j];
      const double error = (leading[j] - (difference - part)) - (leading[i] + part);
      sum.add_product(factor, difference);
      sum.add_product(factor, error + (remainder[j] - remainder[i]));
    }

    /** To the bit (Boost.Serialization). */
    template <class Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &leading &remainder;
    }

  private:
    std::vector<double> leading, remainder;
  };
} // namespace meltfront::reference_fem

#endif
