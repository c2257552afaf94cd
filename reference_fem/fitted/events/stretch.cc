#include <reference_fem/fitted/events/stretch.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::fitted
{
  std::vector<StepRange> lengthening_steps(const double begin, const double end,
                                           const int n, const double power)
  {
    std::vector<StepRange> result;
    const double from = std::pow(begin, 1 / power), to = std::pow(end, 1 / power);
    double last = begin;
    for(int k = 1; k <= n; ++k)
    {
      const double next = k == n ? end : std::pow(from + (to - from) * k / n, power);
      result.push_back({next, next - last});
      last = next;
    }
    return result;
  }

  std::vector<double> widening_shares(const double first, const double ratio,
                                      const double largest, const bool front_first)
  {
    std::vector<double> shares{0};
    for(double width = first; shares.back() < 1; width = std::min(width * ratio, largest))
      shares.push_back(shares.back() + width);
    const double total = shares.back();
    for(double &share : shares)
      share /= total;
    if(!front_first)
    {
      std::reverse(shares.begin(), shares.end());
      for(double &share : shares)
        share = 1 - share;
    }
    return shares;
  }
} // namespace meltfront::reference_fem::fitted
