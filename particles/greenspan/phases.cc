#include <cases/error.h>
#include <particles/greenspan/phases.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  AverageVelocity::AverageVelocity(long interval, double time_step, long window)
    : frames(0)
    , duration(static_cast<double>(window) * time_step)
  {
    if(interval < 1 || window < interval || window % interval != 0 || !(time_step > 0))
      throw cases::InputError(fmt::format("average velocities over {} steps need "
                                          "positions at equal intervals that divide "
                                          "them, not every {} steps",
                                          window, interval));
    frames = static_cast<std::size_t>(window / interval) + 1;
  }

  void AverageVelocity::record(const ParticleState &state)
  {
    position.push_back(state.position);
    if(position.size() > frames)
      position.pop_front();
  }

  bool AverageVelocity::known() const
  {
    return position.size() == frames;
  }

  std::vector<double> AverageVelocity::speed() const
  {
    if(!known())
      throw cases::InputError(
          "average velocities are asked for before their time is over");
    std::vector<double> result(position[0][0].size());
    for(std::size_t i = 0; i < result.size(); ++i)
    {
      double squared = 0;
      for(int d = 0; d < 3 && !position.back()[d].empty(); ++d)
      {
        const double moved = position.back()[d][i] - position.front()[d][i];
        squared += moved * moved;
      }
      result[i] = std::sqrt(squared) / duration;
    }
    return result;
  }

  Cold AverageVelocity::cold() const
  {
    if(!known())
      return Cold(position.empty() ? 0 : position[0][0].size(), 1);
    Cold result;
    for(const double v : speed())
      result.push_back(v <= critical_speed);
    return result;
  }

  std::vector<double> temperatures(const ParticleState &state)
  {
    if(state.kinetic_sum.size() != state.size())
      throw cases::InputError("this run did not keep temperatures");
    std::vector<double> result(state.kinetic_sum);
    for(double &value : result)
      value /= static_cast<double>(std::max(1L, state.step));
    return result;
  }

  Cold cold_by_order(const ParticleState &state, const BondGraph &bonds)
  {
    constexpr double least_order = 0.5;
    Cold result;
    for(const double order : order_of_surroundings(state, bonds))
      result.push_back(order > least_order);
    return result;
  }

  Cold cold_by_temperature(const ParticleState &state)
  {
    Cold result;
    for(const double value : temperatures(state))
      result.push_back(value < critical_temperature);
    return result;
  }
} // namespace meltfront::particles::greenspan
