#include <particles/greenspan/diagnostics.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** A particle of the base that lies higher has left it. */
    constexpr double buckled_height = 0.2;

    /** Fluid particles count from here on: averages need time. */
    constexpr long first_judged_step = 1000;
  } // namespace

  Diagnostics::Diagnostics(const Experiment &experiment)
    : experiment(experiment)
    , first_bonds(experiment.start, experiment.parameters.force.cutoff)
    , average(experiment.interval, experiment.parameters.time_step)
  {
    the_record.corners.resize(experiment.corners.size());
    the_record.least_solid = static_cast<int>(experiment.start.size());
  }

  const std::vector<char> &Diagnostics::solid() const
  {
    return last_solid;
  }

  const RunRecord &Diagnostics::record() const
  {
    return the_record;
  }

  Diagnostics::Memory Diagnostics::memory() const
  {
    return {the_record, average.recorded(), last_solid};
  }

  void Diagnostics::remember(const Memory &memory)
  {
    the_record = memory.record;
    average.resume(memory.positions);
    last_solid = memory.last_solid;
  }

  void Diagnostics::look(const ParticleState &state)
  {
    const BondGraph bonds(state, experiment.parameters.force.cutoff);
    average.record(state);
    const Cold cold = experiment.test == PhaseTest::temperature
                          ? cold_by_temperature(state)
                      : experiment.test == PhaseTest::order ? cold_by_order(state, bonds)
                                                            : average.cold();
    last_solid = bonds.in_triangle(cold);
    const int count
        = static_cast<int>(std::count(last_solid.begin(), last_solid.end(), 1));
    the_record.solid.push_back(count);
    if(state.step >= first_judged_step)
      judge(state.step, count);
    if(the_record.first_break < 0 && first_bonds.shared_with(bonds) < first_bonds.count())
      the_record.first_break = state.step;
    if(the_record.unheated < 0 && experiment.parameters.source && nobody_heated(state))
      the_record.unheated = state.step;
    look_at_corners(state, bonds);
    the_record.highest_y
        = std::max(the_record.highest_y,
                   *std::max_element(state.position[1].begin(), state.position[1].end()));
    if(state.step == experiment.steps)
      finish(state, bonds);
  }

  void Diagnostics::judge(long step, int count)
  {
    the_record.least_solid = std::min(the_record.least_solid, count);
    if(the_record.first_fluid < 0 && count < static_cast<int>(experiment.start.size()))
      the_record.first_fluid = step;
    if(the_record.all_fluid < 0 && count == 0)
      the_record.all_fluid = step;
  }

  bool Diagnostics::nobody_heated(const ParticleState &state) const
  {
    const HeatSource &source = *experiment.parameters.source;
    for(std::size_t i = 0; i < state.size(); ++i)
      if(std::hypot(state.position[0][i] - source.position[0],
                    state.position[1][i] - source.position[1])
         < source.reach)
        return false;
    return true;
  }

  void Diagnostics::look_at_corners(const ParticleState &state, const BondGraph &bonds)
  {
    if(experiment.corners.empty())
      return;
    const std::vector<char> in_triangle = bonds.in_triangle();
    const std::vector<double> temperature = temperatures(state);
    for(std::size_t c = 0; c < experiment.corners.size(); ++c)
    {
      const std::size_t particle = experiment.corners[c] - 1;
      if(the_record.corners[c].step < 0 && !in_triangle[particle])
        the_record.corners[c] = {state.step, temperature[particle]};
    }
  }

  void Diagnostics::finish(const ParticleState &state, const BondGraph &bonds)
  {
    the_record.old_bonds = static_cast<int>(first_bonds.shared_with(bonds));
    const auto &x = state.position[0];
    the_record.lowest_x = *std::min_element(x.begin(), x.end());
    the_record.highest_x = *std::max_element(x.begin(), x.end());
    for(std::size_t i = 0; i < state.size(); ++i)
    {
      if(!last_solid[i])
        the_record.final_fluid.push_back(i + 1);
      the_record.base_buckled |= experiment.start.position[1][i] < buckled_height
                                 && state.position[1][i] > buckled_height;
      for(int d = 0; d < state.dimension; ++d)
        the_record.kinetic_energy += state.velocity[d][i] * state.velocity[d][i] / 2;
    }
    if(!state.kinetic_sum.empty())
      the_record.mean_temperature = spread(temperatures(state)).mean;
  }
} // namespace meltfront::particles::greenspan
