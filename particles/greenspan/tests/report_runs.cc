#include <particles/greenspan/diagnostics.h>
#include <particles/greenspan/tables.h>
#include <particles/greenspan/tests/report_runs.h>

#include <algorithm>
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

  Base heated_base()
  {
    Base base;
    base.hot_half_width = 5;
    return base;
  }

  HeatSource slow_source(double power)
  {
    HeatSource source;
    source.position = {0.2, 5.7, 0};
    source.stages = {{50000, 0.008}, {30000, 0.0095}, {20000, 0.015}};
    source.power = power;
    return source;
  }

  HeatSource fast_source(double power)
  {
    HeatSource source;
    source.position = {0.2, 5.8, 0};
    source.stages = {{30000, 0.02}};
    source.power = power;
    return source;
  }

  Experiment triangle_slow(double power)
  {
    Experiment experiment = triangle("triangle, slow heating", 100000);
    experiment.parameters.source = slow_source(power);
    return experiment;
  }

  Experiment triangle_fast(double power)
  {
    Experiment experiment = triangle("triangle, fast heating", 30000);
    experiment.parameters.source = fast_source(power);
    return experiment;
  }

  Experiment rectangle_on_hot_base()
  {
    Experiment experiment = rectangle("rectangle on the hot base", 50000);
    experiment.parameters.base = heated_base();
    return experiment;
  }

  Experiment rectangle_on_base(double gamma)
  {
    Experiment experiment = rectangle("rectangle on an evenly hot base", 20000);
    Base base = heated_base();
    base.hot_left = gamma;
    base.hot_slope = 0;
    experiment.parameters.base = base;
    return experiment;
  }

  Experiment triangle_unheated()
  {
    return triangle("triangle, unheated", 100000);
  }

  Experiment rectangle_unheated()
  {
    return rectangle("rectangle, unheated", 100000);
  }

  RunRecord run(const Experiment &experiment)
  {
    Motion motion(experiment.parameters, experiment.start);
    Diagnostics diagnostics(experiment);
    ParticleState state = motion.state();
    diagnostics.look(state);
    while(motion.step() < experiment.steps)
    {
      motion.advance(std::min(experiment.interval, experiment.steps - motion.step()));
      diagnostics.look(motion.state());
    }
    return diagnostics.record();
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
