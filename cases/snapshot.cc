#include <cases/snapshot.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::cases
{
  double HeatBudget::imbalance() const
  {
    return conservative ? stored + latent - initial - boundary - sources
                        : std::numeric_limits<double>::quiet_NaN();
  }

  double HeatBudget::defect() const
  {
    if(!conservative)
      return std::numeric_limits<double>::quiet_NaN();
    if(!std::isfinite(imbalance()))
      return std::numeric_limits<double>::infinity();
    const double scale = std::max({std::abs(stored) + std::abs(latent), std::abs(initial),
                                   std::abs(boundary), std::abs(sources)});
    if(scale == 0)
      return 0;
    return std::abs(imbalance()) / scale;
  }

  double SubstanceBudget::defect() const
  {
    if(!std::isfinite(now) || !std::isfinite(initial))
      return std::numeric_limits<double>::infinity();
    if(initial == 0)
      return now == 0 ? 0 : std::numeric_limits<double>::infinity();
    return std::abs((now - initial) / initial);
  }
} // namespace meltfront::cases
