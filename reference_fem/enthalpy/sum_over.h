#ifndef meltfront_reference_fem_enthalpy_sum_over_h
#define meltfront_reference_fem_enthalpy_sum_over_h

#include <cstddef>
#include <vector>

namespace meltfront::reference_fem
{
  /** Sum of volume times enthalpy, in extended precision: a balance to 1e-13 over many
   * nodes must not end in the sum's own round-off. */
  template <typename Value>
  double sum_over(const std::vector<double> &volume, const Value &value)
  {
    long double sum = 0;
    for(std::size_t i = 0; i < volume.size(); ++i)
      sum += static_cast<long double>(volume[i]) * value(i);
    return static_cast<double>(sum);
  }
} // namespace meltfront::reference_fem

#endif
