#include <reference_fem/cut/released_heat.h>

#include <boost/container_hash/hash.hpp>

namespace meltfront::reference_fem::cut
{
  ReleasedHeat::ReleasedHeat(const cases::Field &density)
    : mean(density)
  {
  }

  std::size_t ReleasedHeat::Hash::operator()(const cases::Position &position) const
  {
    return boost::hash_range(position.begin(), position.end());
  }

  double ReleasedHeat::operator()(const cases::Position &position, double begin,
                                  double end)
  {
    if(mean.field().constant)
      return mean(position, begin, end);
    const auto of_step
        = [&](const Step &step) { return step.begin == begin && step.end == end; };
    std::size_t at = oldest;
    if(of_step(steps[0]) || of_step(steps[1]))
      at = of_step(steps[0]) ? 0 : 1;
    else
    {
      steps[at] = {begin, end, {}};
      oldest = 1 - at;
    }
    const auto [found, unknown] = steps[at].means.try_emplace(position);
    if(unknown)
      found->second = mean(position, begin, end);
    return found->second;
  }

  std::size_t ReleasedHeat::bytes() const
  {
    return (steps[0].means.size() + steps[1].means.size())
           * (sizeof(cases::Position) + sizeof(double));
  }
} // namespace meltfront::reference_fem::cut
