#ifndef meltfront_verification_report_plots_solid_plots_h
#define meltfront_verification_report_plots_solid_plots_h

#include <verification/report/page/case_runs.h>
#include <verification/report/plots/plot.h>
#include <verification/report/tables/table.h>

namespace meltfront::verification
{
  /** The mean number of solid particles of a case against time, with a band of one
   * standard deviation over the runs, one line for each label; printed numbers as points
   * at their intermediate times. Nothing to draw where the number never changes. */
  Plot solid_particles_over_time(const CaseRuns &runs, const MethodStyles &styles);

  /** Energy of a particle against temperature, means over the stages of the case's runs
   * in their order, with the spread of runs; labels of one stage have a point. Nothing to
   * draw where runs have no stages. */
  Plot energy_over_temperature(const CaseRuns &runs, const MethodStyles &styles);

  /** Largest change of the energy against the time step, over all labels. */
  Plot energy_over_time_step(const CaseRuns &runs, const MethodStyles &styles);

  /** The same with the ratio of each error to that of the next smaller step; empty for
   * less than two time steps. */
  Table energy_table(const CaseRuns &runs);
} // namespace meltfront::verification

#endif
