#ifndef meltfront_particles_greenspan_tests_report_runs_h
#define meltfront_particles_greenspan_tests_report_runs_h

#include <particles/greenspan/experiments.h>

namespace meltfront::particles::greenspan
{
  /** Equation (5.1). */
  Base heated_base();

  /** The source of figure 4.1: slow heating at (0.2, 5.7). */
  HeatSource slow_source(double power);

  /** That of figure 4.2: fast heating at (0.2, 5.8). */
  HeatSource fast_source(double power);

  /** Section 4, figure 4.1. @param power 2 as printed, -2 as the figures need */
  Experiment triangle_slow(double power);

  /** Section 4, figure 4.2. */
  Experiment triangle_fast(double power);

  /** Section 5, figure 5.2. */
  Experiment rectangle_on_hot_base();

  /** Section 6: gamma = 2.5 all over the heated part. */
  Experiment rectangle_on_base(double gamma);

  /** Controls: nothing is heated. */
  Experiment triangle_unheated();
  Experiment rectangle_unheated();

  /** One run from the start as it is. */
  RunRecord run(const Experiment &experiment);

  /**
   * Runs of an experiment from starts that were disturbed with the seeds first_seed,
   * first_seed + 1, ...: trajectories are chaotic, so that only their distribution can be
   * compared.
   * @param deviation of the noise on the positions
   * @param threads that share the runs; the records do not depend on it
   */
  std::vector<RunRecord> run_ensemble(const Experiment &experiment, int members,
                                      double deviation = 1e-6,
                                      std::uint64_t first_seed = 1, int threads = 1);

  /** Spread of what a function takes from each record; values that are not finite are
   * left out. */
  template <typename Value>
  Spread spread_of(const std::vector<RunRecord> &records, const Value &value)
  {
    std::vector<double> values;
    for(const RunRecord &record : records)
      values.push_back(value(record));
    return spread(values);
  }

  /** How often each particle (counted from 1; entry 0 stays 0) is fluid at the end. */
  std::vector<int> final_fluid_counts(const std::vector<RunRecord> &records,
                                      std::size_t particles);
} // namespace meltfront::particles::greenspan

#endif
