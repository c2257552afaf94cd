#include <cases/error.h>
#include <particles/rkpm/supports.h>
#include <particles/rkpm_tracked/line/stencils.h>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace meltfront::particles::rkpm_tracked
{
  LineStencils::LineStencils(int order)
    : order(order)
  {
    for(int m = 1; m <= order; ++m)
    {
      rkpm::MomentSettings settings;
      settings.variant = rkpm::Variant::fixed_point;
      settings.kernel = KernelShape::cubic_spline;
      settings.dimension = 1;
      settings.order = m;
      engines.emplace_back(settings);
    }
  }

  void LineStencils::find_window(double place, double reach, const std::vector<double> &x)
  {
    const auto first = std::upper_bound(x.begin(), x.end(), place - reach);
    const auto end = std::lower_bound(first, x.end(), place + reach);
    neighbours.resize(static_cast<std::size_t>(end - first));
    std::iota(neighbours.begin(), neighbours.end(),
              static_cast<std::uint32_t>(first - x.begin()));
  }

  void LineStencils::evaluate(double place, double reach, const ParticleStorage &cloud,
                              LineStencil &stencil)
  {
    const std::vector<double> &x = cloud.position[0];
    const std::size_t wanted = std::min(x.size(), static_cast<std::size_t>(order) + 2);
    do
      find_window(place, reach, x);
    while(neighbours.size() < wanted && (reach *= rkpm::enlargement_factor) > 0);
    // Points that all but coincide may not determine the order that they are enough for.
    for(int possible = std::min(order, static_cast<int>(neighbours.size()) - 1);
        possible >= 1; --possible)
    {
      rkpm::MomentEngine &engine = engines[static_cast<std::size_t>(possible - 1)];
      if(!engine.evaluate({place, 0, 0}, cloud, neighbours, reach))
        continue;
      stencil.first = neighbours.front();
      stencil.radius = reach;
      const auto slope = engine.weights(1), second = engine.weights(2);
      stencil.slope.assign(slope.begin(), slope.end());
      stencil.second.assign(second.begin(), second.end());
      return;
    }
    throw cases::InputError(
        fmt::format("rkpm-tracked: the {} points about x = {:.6g} determine no slope",
                    x.size(), place));
  }
} // namespace meltfront::particles::rkpm_tracked
