#ifndef meltfront_verification_report_cost_at_error_h
#define meltfront_verification_report_cost_at_error_h

#include <verification/report/case_runs.h>

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

  /** front_rms over the exact front at the end, against CPU seconds. Empty without an
   * exact front. */
  WorkPrecision relative_front_work_precision(const LabelRuns &runs,
                                              const CaseRecord &record);

  /** The label of least cost at which the case reaches a relative front error. */
  CostAtError cheapest(const CaseRuns &runs, double wanted);
} // namespace meltfront::verification

#endif
