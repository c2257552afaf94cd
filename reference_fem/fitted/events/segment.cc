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

  RayMesh seed_mesh(const RayScene &rays, const bool inner, const double layer,
                    const double far_layer)
  {
    const int cells = rays.cells;
    const double length = rays.outer - rays.inner;
    const auto from_layer
        = [&](const double thickness, const double part, const bool first)
    {
      return widening_shares(4 * thickness / (cells * length * part),
                             1 + 8. / std::max(cells, 8), 2. / (cells * part), first);
    };
    std::vector<double> old;
    if(far_layer > 0)
    {
      for(const double share : from_layer(inner ? layer : far_layer, 0.5, true))
        old.push_back(share / 2);
      const std::vector<double> rest = from_layer(inner ? far_layer : layer, 0.5, false);
      for(auto share = rest.begin() + 1; share != rest.end(); ++share)
        old.push_back(0.5 + *share / 2);
    }
    else
      old = from_layer(layer, 1, inner);
    const std::vector<double> equal = graded_shares(std::max(1, cells / 2), 1, false);
    return {rays.surface, rays.inner, rays.outer, inner ? equal : old,
            inner ? old : equal};
  }
} // namespace meltfront::reference_fem::fitted
