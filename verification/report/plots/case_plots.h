#ifndef meltfront_verification_report_plots_case_plots_h
#define meltfront_verification_report_plots_case_plots_h

#include <verification/report/page/case_runs.h>
#include <verification/report/plots/plot.h>

namespace meltfront::verification
{
  /** Front error (RMS) against the spacing, one line per label that refines it, with
   * slopes 1 and 2. Where there is no exact solution, here and in the next two the error
   * is that of the solid's volume at the end from the reference. */
  Plot error_against_spacing(const CaseRuns &runs, const MethodStyles &styles);

  /** The same against the time step, of the labels that refine that, with slopes 2 and 4;
   * of the front at the end, which few steps have too. */
  Plot error_against_time_step(const CaseRuns &runs, const MethodStyles &styles);

  /** Front error (RMS) against CPU seconds: the work-precision diagram. Where methods run
   * in different dimensions, their curves say in which. */
  Plot error_against_cost(const CaseRuns &runs, const MethodStyles &styles);

  /** The same relative to the exact front at the end, small, for comparing cases; of the
   * labels that run in one dimension.
   * @param cost `cpu_seconds` or `work` */
  Plot small_work_precision(const CaseRuns &runs, const MethodStyles &styles,
                            int dimension, const std::string &cost = "cpu_seconds");

  /** Front against time: the finest run of every label and the exact front. */
  Plot front_against_time(const CaseRuns &runs, const MethodStyles &styles);

  /** Front against time of all resolutions of one label, and the exact front. */
  Plot front_of_resolutions(const CaseRuns &runs, const LabelRuns &label);

  /** |front - exact front| against time, finest runs. */
  Plot front_error_against_time(const CaseRuns &runs, const MethodStyles &styles);

  /** Volume that is solid against time, finest runs. */
  Plot solid_against_time(const CaseRuns &runs, const MethodStyles &styles);

  /** Relative defect of the heat budget against time, finest runs. Defects below 1e-17
   * are drawn there. */
  Plot budget_against_time(const CaseRuns &runs, const MethodStyles &styles);
} // namespace meltfront::verification

#endif
