#include <particles/greenspan/experiments.h>
#include <particles/greenspan/random_numbers.h>
#include <particles/greenspan/tables.h>
#include <particles/greenspan/witness.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace meltfront::particles::greenspan
{
  namespace
  {
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
    return witness.record();
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
