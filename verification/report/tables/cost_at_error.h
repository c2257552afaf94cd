#ifndef meltfront_verification_report_tables_cost_at_error_h
#define meltfront_verification_report_tables_cost_at_error_h

#include <verification/report/page/case_runs.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Errors and costs of a method over its resolutions, coarse to fine. */
  struct WorkPrecision
  {
    std::vector<double> error;
    std::vector<double> cost;
  };

  /** How a cost was found. */
  enum class Reach
  {
    not_reached,
    interpolated, ///< between the two levels that bracket the wanted error
    coarsest      ///< the coarsest level measured is already better: an upper bound
  };

  struct CostAtError
  {
    Reach reach = Reach::not_reached;
    double cost = 0;
    std::string label; ///< set by cheapest()
  };

  /**
   * The cost at which an error is reached and kept on all finer levels, interpolated
   * linearly between logarithms within the measured range. Nothing is extrapolated: an
   * error below that of the finest level is not reached. Levels whose error or cost is
   * not a positive number are left out.
   */
  CostAtError cost_at_error(const WorkPrecision &measured, double wanted);

  /** shown_error() over main_error_scale(), against CPU seconds. Empty where there is no
   * such scale. */
  WorkPrecision relative_work_precision(const LabelRuns &label, const CaseRuns &runs);

  /** Whether some label of a case has a relative error. */
  bool has_relative_error(const CaseRuns &runs);

  /** The label of least cost at which the case reaches a relative error. */
  CostAtError cheapest(const CaseRuns &runs, double wanted);
} // namespace meltfront::verification

#endif
