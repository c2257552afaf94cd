#ifndef meltfront_verification_report_plots_seed_curves_h
#define meltfront_verification_report_plots_seed_curves_h

#include <verification/report/page/case_runs.h>
#include <verification/report/plots/method_styles.h>
#include <verification/report/plots/plot.h>

#include <functional>

namespace meltfront::verification
{
  /** A value of a run's series at the index of a time. */
  using SeriesValue = std::function<double(const RunSeries &, std::size_t)>;

  /** Mean over those runs of a level that were sampled at the same times, with a band of
   * one standard deviation where there are several. */
  Curve mean_over_runs(const Level &level, const SeriesValue &value);

  /** The square of the front's position against time, each method's finest n: a front
   * that follows the root of the time is a straight line. */
  Plot front_squared_against_time(const CaseRuns &runs, const MethodStyles &styles);
} // namespace meltfront::verification

#endif
