#include <reference_fem/enthalpy/distributed/shared_search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace meltfront::reference_fem
{
  double lowest_of_all(KinkedDerivative &own, MPI_Comm communicator, Traffic &traffic)
  {
    constexpr std::size_t n_lengths = 16;
    constexpr double narrow = 1e-6;
    using Kink = KinkedDerivative::Kink;
    std::ranges::sort(own.kinks, {}, &Kink::length);
    // After each kink: what the jumps and the changes of the slope sum up to.
    std::vector<double> jumps{0}, changes{0}, moments{0};
    for(const Kink &kink : own.kinks)
    {
      jumps.push_back(jumps.back() + kink.jump);
      changes.push_back(changes.back() + kink.change);
      moments.push_back(moments.back() + kink.change * kink.length);
    }
    const auto passed = [&](double length)
    {
      return static_cast<std::size_t>(
          std::ranges::upper_bound(own.kinks, length, {}, &Kink::length)
          - own.kinks.begin());
    };
    // Of the functional to the right of a length.
    const auto derivative = [&](double length)
    {
      const std::size_t k = passed(length);
      return own.start + own.slope * length + jumps[k] + changes[k] * length - moments[k];
    };
    double lower = 0, upper = 1, at_lower = 0, at_upper = 0;
    for(bool first = true;; first = false)
    {
      // The values at the lengths, and the number of kinks between them.
      std::array<double, 2 * n_lengths> sums{};
      const auto length_of = [&](std::size_t k)
      {
        return k + 1 == n_lengths
                   ? upper
                   : lower + (upper - lower) * static_cast<double>(k) / (n_lengths - 1);
      };
      for(std::size_t k = 0; k < n_lengths; ++k)
      {
        sums[k] = derivative(length_of(k));
        if(k > 0)
          sums[n_lengths + k]
              = static_cast<double>(passed(length_of(k)) - passed(length_of(k - 1)));
      }
      const dealii::ArrayView<double> view(sums.data(), sums.size());
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(view), communicator,
                                  view);
      ++traffic.reductions;
      if(first && sums[0] >= 0)
        return 0;
      if(first && sums[n_lengths - 1] <= 0)
        return 1;
      std::size_t k = 1;
      while(k + 1 < n_lengths && sums[k] < 0)
        ++k;
      const double next_lower = length_of(k - 1), next_upper = length_of(k);
      at_lower = sums[k - 1];
      at_upper = sums[k];
      lower = next_lower;
      upper = next_upper;
      if(upper - lower <= narrow || sums[n_lengths + k] == 0)
        break;
    }
    if(!(at_upper > at_lower))
      return lower;
    return std::clamp(lower - at_lower * (upper - lower) / (at_upper - at_lower), lower,
                      upper);
  }
} // namespace meltfront::reference_fem
