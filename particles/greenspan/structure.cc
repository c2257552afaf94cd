#include <cases/numbers.h>
#include <particles/greenspan/motion/bonds.h>
#include <particles/greenspan/structure.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    constexpr double bin_width = 0.02, greatest_distance = 2.4; ///< in the unit
    constexpr int bins = static_cast<int>(greatest_distance / bin_width);
    constexpr double rise_to_peak = 1.2; ///< of a maximum over the least value beside it
    constexpr double least_rise = 0.05;  ///< of the temperature, for a heat capacity

    /** Each value averaged with those beside it, 1 : 2 : 1. */
    std::vector<double> smoothed(const std::vector<double> &values)
    {
      std::vector<double> result(values);
      for(std::size_t i = 1; i + 1 < values.size(); ++i)
        result[i] = (values[i - 1] + 2 * values[i] + values[i + 1]) / 4;
      return result;
    }
  } // namespace

  PairCorrelation::PairCorrelation(double unit)
    : unit(unit)
    , count(bins, 0)
  {
  }

  void PairCorrelation::add(const ParticleState &state)
  {
    dimension = state.dimension;
    const BondGraph near(state, greatest_distance * unit);
    for(std::size_t a = 0; a < near.size(); ++a)
      for(const std::uint32_t b : near[a])
        if(b > a)
        {
          const double in_bins = distance(state, a, b) / unit / bin_width;
          count[std::min(bins - 1, static_cast<int>(in_bins))] += 1;
        }
  }

  std::vector<double> PairCorrelation::peaks() const
  {
    std::vector<double> g(count);
    for(int i = 0; i < bins; ++i)
      g[i] /= std::pow(i + 0.5, dimension - 1);
    g = smoothed(smoothed(g));
    double floor = 0; // half of the mean beyond the unit: below it there is only noise
    for(int i = bins / 2; i < bins; ++i)
      floor += g[i] / bins;
    std::vector<double> result;
    double least = g[0];
    int highest = 0; // of the rise that is under way
    for(int i = 1; i + 1 < bins; ++i)
    {
      if(g[i] > g[highest] || g[i] < least)
        highest = i;
      least = std::min(least, g[i]);
      if(g[highest] > floor && g[highest] > rise_to_peak * least
         && g[i] * rise_to_peak < g[highest])
      {
        const double before = g[highest - 1], at = g[highest], after = g[highest + 1];
        const double shift = (before - after) / (2 * (before - 2 * at + after));
        result.push_back((highest + 0.5 + shift) * bin_width);
        least = g[i];
        highest = i;
      }
    }
    return result;
  }

  Structure::Structure(const Experiment &experiment)
    : experiment(experiment)
    , bond_length(experiment.parameters.force.equilibrium_distance()
                  * (1 + std::sqrt(experiment.start.dimension == 3 ? 2 : 3)) / 2)
    , stages(experiment.stages.size())
    , correlation(experiment.parameters.force.equilibrium_distance())
    , with_partners(experiment.start.size(), 0)
  {
  }

  void Structure::look(const ParticleState &state, double energy,
                       const std::vector<char> &solid)
  {
    const auto of_step = [&state](const RunStage &stage)
    { return state.step > stage.begin && state.step <= stage.end; };
    const auto stage = std::ranges::find_if(experiment.stages, of_step);
    if(stage == experiment.stages.end())
      return;
    const auto number = static_cast<std::size_t>(stage - experiment.stages.begin());
    Sums &sums = stages[number];
    if(2 * state.step < stage->begin + stage->end)
      return;
    const auto n = static_cast<double>(state.size());
    ++sums.looks;
    sums.energy += energy / n;
    for(int d = 0; d < state.dimension; ++d)
      for(const double v : state.velocity[d])
        sums.temperature += v * v / (state.dimension * n);
    look_at_heights(state, sums, solid);
    look_at_bonds(state, sums, number + 1 == stages.size());
  }

  void Structure::look_at_heights(const ParticleState &state, Sums &sums,
                                  const std::vector<char> &solid)
  {
    const std::vector<double> &y = state.position[1];
    const double middle = spread(y).mean;
    /** Of the lower and the upper half, of fluid and solid particles. */
    double energy[2]{}, in_half[2]{}, height[2]{}, in_phase[2]{};
    for(std::size_t i = 0; i < state.size(); ++i)
    {
      for(int d = 0; d < state.dimension; ++d)
        energy[y[i] > middle] += state.velocity[d][i] * state.velocity[d][i];
      ++in_half[y[i] > middle];
      height[solid[i] != 0] += y[i];
      ++in_phase[solid[i] != 0];
    }
    sums.warmer_above
        += (energy[1] / in_half[1] - energy[0] / in_half[0]) / state.dimension;
    if(in_phase[0] > 0 && in_phase[1] > 0)
    {
      sums.fluid_above_solid += height[0] / in_phase[0] - height[1] / in_phase[1];
      ++sums.looks_at_both;
    }
  }

  void Structure::look_at_bonds(const ParticleState &state, Sums &sums, bool last)
  {
    const BondGraph bonds(state, bond_length);
    sums.partners += bonds.coordination();
    if(state.dimension == 2)
      sums.order += hexatic_order(state, bonds);
    if(sums.looks == 1)
    {
      for(std::uint32_t a = 0; a < bonds.size(); ++a)
        for(const std::uint32_t b : bonds[a])
          if(b > a)
            sums.bonds.push_back({a, b});
      sums.length.assign(sums.bonds.size(), 0);
      sums.squared_length.assign(sums.bonds.size(), 0);
    }
    for(std::size_t k = 0; k < sums.bonds.size(); ++k)
    {
      const double length = distance(state, sums.bonds[k][0], sums.bonds[k][1]);
      sums.length[k] += length;
      sums.squared_length[k] += length * length;
    }
    if(!last)
      return;
    correlation.add(state);
    for(std::size_t a = 0; a < bonds.size(); ++a)
      ++with_partners[bonds[a].size()];
  }

  double Structure::lindemann(const Sums &sums) const
  {
    double result = 0;
    for(std::size_t k = 0; k < sums.bonds.size(); ++k)
    {
      const double mean = sums.length[k] / sums.looks;
      const double variance = sums.squared_length[k] / sums.looks - mean * mean;
      result += std::sqrt(std::max(0., variance)) / mean;
    }
    return result / static_cast<double>(sums.bonds.size());
  }

  bool Structure::same_bath(std::size_t stage, std::size_t other) const
  {
    if(experiment.parameters.zones.empty() || stages[other].looks == 0)
      return false;
    const Thermostat &bath = experiment.parameters.zones.front().bath;
    const auto middle = [&](std::size_t s)
    {
      const RunStage &of = experiment.stages[s];
      return bath.temperature(of.begin + 3 * (of.end - of.begin) / 4);
    };
    return middle(stage) == middle(other);
  }

  double Structure::rise(std::size_t stage) const
  {
    if(stage == 0 || stage >= stages.size())
      return 0;
    const Sums &before = stages[stage - 1], &after = stages[stage];
    return before.looks == 0 || after.looks == 0
               ? 0
               : after.temperature / after.looks - before.temperature / before.looks;
  }

  double Structure::heat_capacity(std::size_t stage) const
  {
    const Sums &before = stages[stage - 1], &after = stages[stage];
    return (after.energy / after.looks - before.energy / before.looks) / rise(stage);
  }

  std::map<std::string, double> Structure::report() const
  {
    std::map<std::string, double> values;
    for(std::size_t s = 0; s < stages.size(); ++s)
    {
      const Sums &sums = stages[s];
      if(sums.looks == 0)
        continue;
      const auto tell = [&](const char *name, double value)
      { values[fmt::format("{}_stage_{}", name, s + 1)] = value; };
      tell("temperature", sums.temperature / sums.looks);
      tell("energy", sums.energy / sums.looks);
      tell("partners", sums.partners / sums.looks);
      if(experiment.start.dimension == 2)
        tell("hexatic_order", sums.order / sums.looks);
      tell("lindemann", lindemann(sums));
      tell("warmer_above", sums.warmer_above / sums.looks);
      if(sums.looks_at_both > 0)
        tell("fluid_above_solid", sums.fluid_above_solid / sums.looks_at_both);
      for(std::size_t earlier = 0; earlier < s; ++earlier)
        if(same_bath(s, earlier))
          tell("energy_changed",
               sums.energy / sums.looks - stages[earlier].energy / stages[earlier].looks);
      if(std::abs(rise(s)) > least_rise * sums.temperature / sums.looks)
        tell("heat_capacity", heat_capacity(s));
      if(rise(s) * rise(s + 1) > 0 && s >= 1 && rise(s) * rise(s - 1) > 0)
        tell("latent_heat", rise(s)
                                * (heat_capacity(s)
                                   - (heat_capacity(s - 1) + heat_capacity(s + 1)) / 2));
    }
    const std::vector<double> peaks = correlation.peaks();
    for(std::size_t p = 0; p < std::min<std::size_t>(4, peaks.size()); ++p)
      values[fmt::format("peak_{}", p + 1)] = p == 0 ? peaks[0] : peaks[p] / peaks[0];
    values["partners_of_most_end"] = static_cast<double>(
        std::ranges::max_element(with_partners) - with_partners.begin());
    return values;
  }
} // namespace meltfront::particles::greenspan
