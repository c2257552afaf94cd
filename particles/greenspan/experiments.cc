#include <particles/greenspan/experiments.h>
#include <particles/greenspan/motion/random_numbers.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  void disturb(ParticleState &state, double deviation, std::uint64_t seed)
  {
    RandomNumbers random(seed);
    for(std::size_t i = 0; i < state.size(); ++i)
      for(int d = 0; d < state.dimension; ++d)
      {
        state.position[d][i] += deviation * random.normal();
        if(d == 1)
          state.position[d][i] = std::max(0., state.position[d][i]);
      }
  }

  double Spread::standard_error() const
  {
    return count > 0 ? deviation / std::sqrt(static_cast<double>(count)) : 0;
  }

  Spread spread(const std::vector<double> &values)
  {
    Spread result;
    for(const double value : values)
      if(std::isfinite(value))
      {
        result.mean += value;
        ++result.count;
      }
    if(result.count == 0)
      return result;
    result.mean /= result.count;
    for(const double value : values)
      if(std::isfinite(value))
        result.deviation += (value - result.mean) * (value - result.mean);
    result.deviation = std::sqrt(result.deviation / std::max(1, result.count - 1));
    return result;
  }
} // namespace meltfront::particles::greenspan
