#include <reference_fem/fitted/events/segment.h>

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

  double widening(const RayScene &rays)
  {
    return 1 + 8. / std::max(rays.cells, 8);
  }

  std::vector<double> shares_of_layers(const RayScene &rays, const double at_inner,
                                       const double at_outer)
  {
    const int cells = rays.cells;
    const double length = rays.outer - rays.inner;
    const auto from_layer
        = [&](const double thickness, const double part, const bool first)
    {
      return widening_shares(4 * thickness / (cells * length * part), widening(rays),
                             2. / cells, first);
    };
    if(at_inner == 0 || at_outer == 0)
      return from_layer(std::max(at_inner, at_outer), 1, at_inner > 0);
    // Each half like a whole ray.
    std::vector<double> result;
    for(const double share : from_layer(at_inner, 0.5, true))
      result.push_back(share / 2);
    const std::vector<double> rest = from_layer(at_outer, 0.5, false);
    for(auto share = rest.begin() + 1; share != rest.end(); ++share)
      result.push_back(0.5 + *share / 2);
    return result;
  }

  std::vector<double> drawn_shares(const std::vector<double> &shares, const double first,
                                   const double ratio, const bool to_lower)
  {
    const auto mirrored = [](std::vector<double> values)
    {
      std::ranges::reverse(values);
      for(double &value : values)
        value = 1 - value;
      return values;
    };
    const std::vector<double> old = to_lower ? shares : mirrored(shares);
    std::vector<double> result{0};
    std::size_t next = 1; // face of the old cells beyond the last new one
    for(double width = first;; width *= ratio)
    {
      while(old[next] <= result.back())
        ++next;
      if(width >= old[next] - old[next - 1] || result.back() + width >= 1)
        break;
      result.push_back(result.back() + width);
    }
    // Leave no cell that is narrower than half its neighbour.
    const std::size_t n = result.size();
    if(n > 1 && old[next] - result[n - 1] < 0.5 * (result[n - 1] - result[n - 2]))
      result.pop_back();
    result.insert(result.end(), old.begin() + static_cast<std::ptrdiff_t>(next),
                  old.end());
    return to_lower ? result : mirrored(result);
  }
} // namespace meltfront::reference_fem::fitted
