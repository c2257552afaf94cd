#include <cases/snapshot.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  double HeatBudget::defect() const
  {
    const double scale = std::max({std::abs(stored) + std::abs(latent), std::abs(initial),
                                   std::abs(boundary), std::abs(sources)});
    if(scale == 0)
      return 0;
    return std::abs(stored + latent - initial - boundary - sources) / scale;
  }
} // namespace meltfront::cases
