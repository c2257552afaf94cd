#include <particles/greenspan/experiments.h>
#include <particles/greenspan/random_numbers.h>
#include <particles/greenspan/tables.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** A particle of the base that lies higher has left it. */
    constexpr double buckled_height = 0.2;

    /** Fluid particles count from here on: averages need time. */
    constexpr long first_judged_step = 1000;

    Experiment triangle(const char *name, long steps)
    {
      Experiment experiment;
      experiment.name = name;
      experiment.start = read_table(1);
      experiment.parameters.force = PairForce::triangle();
      experiment.parameters.base = Base{};
      experiment.steps = steps;
      return experiment;
    }

    Experiment rectangle(const char *name, long steps)
    {
      Experiment experiment;
      experiment.name = name;
      experiment.start = read_table(2);
      experiment.parameters.force = PairForce::rectangle();
      experiment.parameters.base = Base{};
      experiment.parameters.temperatures = true;
      experiment.test = PhaseTest::temperature;
      experiment.steps = steps;
      experiment.corners = {1, 7};
      return experiment;
    }

    /** Looks at a run and writes its record. */
    class Witness
    {
    public:
      explicit Witness(const Experiment &experiment)
        : experiment(experiment)
        , first_bonds(experiment.start.dimension, experiment.start.position,
                      experiment.parameters.force.cutoff)
        , average(experiment.interval, experiment.parameters.time_step)
      {
        record.corners.resize(experiment.corners.size());
        record.least_solid = static_cast<int>(experiment.start.size());
      }

      void look(const ParticleState &state)
      {
        const BondGraph bonds(state.dimension, state.position,
                              experiment.parameters.force.cutoff);
        average.record(state);
        const Cold cold = experiment.test == PhaseTest::temperature
                              ? cold_by_temperature(state)
                              : average.cold();
        const std::vector<char> solid = bonds.in_triangle(cold);
        const int count = static_cast<int>(std::count(solid.begin(), solid.end(), 1));
        record.solid.push_back(count);
        if(state.step >= first_judged_step)
          judge(state.step, count);
        if(record.first_break < 0 && first_bonds.shared_with(bonds) < first_bonds.count())
          record.first_break = state.step;
        if(record.unheated < 0 && experiment.parameters.source && nobody_heated(state))
          record.unheated = state.step;
        look_at_corners(state, bonds);
        record.highest_y
            = std::max(record.highest_y, *std::max_element(state.position[1].begin(),
                                                           state.position[1].end()));
        if(state.step == experiment.steps)
          finish(state, bonds, solid);
      }

      RunRecord record;

    private:
      void judge(long step, int count)
      {
        record.least_solid = std::min(record.least_solid, count);
        if(record.first_fluid < 0 && count < static_cast<int>(experiment.start.size()))
          record.first_fluid = step;
        if(record.all_fluid < 0 && count == 0)
          record.all_fluid = step;
      }

      bool nobody_heated(const ParticleState &state) const
      {
        const HeatSource &source = *experiment.parameters.source;
        for(std::size_t i = 0; i < state.size(); ++i)
          if(std::hypot(state.position[0][i] - source.position[0],
                        state.position[1][i] - source.position[1])
             < source.reach)
            return false;
        return true;
      }

      void look_at_corners(const ParticleState &state, const BondGraph &bonds)
      {
        if(experiment.corners.empty())
          return;
        const std::vector<char> in_triangle = bonds.in_triangle();
        const std::vector<double> temperature = temperatures(state);
        for(std::size_t c = 0; c < experiment.corners.size(); ++c)
        {
          const std::size_t particle = experiment.corners[c] - 1;
          if(record.corners[c].step < 0 && !in_triangle[particle])
            record.corners[c] = {state.step, temperature[particle]};
        }
      }

      void finish(const ParticleState &state, const BondGraph &bonds,
                  const std::vector<char> &solid)
      {
        record.old_bonds = static_cast<int>(first_bonds.shared_with(bonds));
        const auto &x = state.position[0];
        record.lowest_x = *std::min_element(x.begin(), x.end());
        record.highest_x = *std::max_element(x.begin(), x.end());
        for(std::size_t i = 0; i < state.size(); ++i)
        {
          if(!solid[i])
            record.final_fluid.push_back(i + 1);
          record.base_buckled |= experiment.start.position[1][i] < buckled_height
                                 && state.position[1][i] > buckled_height;
          for(int d = 0; d < state.dimension; ++d)
            record.kinetic_energy += state.velocity[d][i] * state.velocity[d][i] / 2;
        }
        if(!state.kinetic_sum.empty())
          record.mean_temperature = spread(temperatures(state)).mean;
      }

      const Experiment &experiment;
      BondGraph first_bonds;
      AverageVelocity average;
    };
  } // namespace

  Experiment Experiment::triangle_slow(double power)
  {
    Experiment experiment = triangle("triangle, slow heating", 100000);
    experiment.parameters.source = HeatSource::slow(power);
    return experiment;
  }

  Experiment Experiment::triangle_fast(double power)
  {
    Experiment experiment = triangle("triangle, fast heating", 30000);
    experiment.parameters.source = HeatSource::fast(power);
    return experiment;
  }

  Experiment Experiment::rectangle_on_hot_base()
  {
    Experiment experiment = rectangle("rectangle on the hot base", 50000);
    experiment.parameters.base = Base::heated();
    return experiment;
  }

  Experiment Experiment::rectangle_on_base(double gamma)
  {
    Experiment experiment = rectangle("rectangle on an evenly hot base", 20000);
    experiment.parameters.base = Base::heated_evenly(gamma);
    return experiment;
  }

  Experiment Experiment::triangle_unheated()
  {
    return triangle("triangle, unheated", 100000);
  }

  Experiment Experiment::rectangle_unheated()
  {
    return rectangle("rectangle, unheated", 100000);
  }

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

  RunRecord run(const Experiment &experiment)
  {
    Motion motion(experiment.parameters, experiment.start);
    Witness witness(experiment);
    ParticleState state = motion.state();
    witness.look(state);
    while(motion.step() < experiment.steps)
    {
      motion.advance(std::min(experiment.interval, experiment.steps - motion.step()));
      witness.look(motion.state());
    }
    return witness.record;
  }

  std::vector<RunRecord> run_ensemble(const Experiment &experiment, int members,
                                      double deviation, std::uint64_t first_seed,
                                      int threads)
  {
    std::vector<RunRecord> records(std::max(0, members));
    std::vector<std::exception_ptr> failures(records.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads) if(threads > 1)
    for(int member = 0; member < members; ++member)
      try
      {
        Experiment disturbed = experiment;
        disturb(disturbed.start, deviation, first_seed + member);
        records[member] = run(disturbed);
      }
      catch(...)
      {
        failures[member] = std::current_exception();
      }
    for(const std::exception_ptr &failure : failures)
      if(failure)
        std::rethrow_exception(failure);
    return records;
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

  std::vector<int> final_fluid_counts(const std::vector<RunRecord> &records,
                                      std::size_t particles)
  {
    std::vector<int> counts(particles + 1, 0);
    for(const RunRecord &record : records)
      for(const std::uint32_t particle : record.final_fluid)
        ++counts.at(particle);
    return counts;
  }
} // namespace meltfront::particles::greenspan
