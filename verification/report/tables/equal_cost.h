#ifndef meltfront_verification_report_tables_equal_cost_h
#define meltfront_verification_report_tables_equal_cost_h

#include <verification/report/page/case_runs.h>
#include <verification/report/tables/table.h>

#include <vector>

namespace meltfront::verification
{
  /** Relative errors that a table of costs has columns for: the decades from 1e-2 to
   * 1e-4, and finer ones up to the first that no case reaches, 1e-8 at most. */
  std::vector<double> wanted_errors(const std::vector<CaseRuns> &cases);

  /**
   * CPU seconds of every method at the same relative errors (cost_at_error()), by the
   * dimension that it runs in, the least of a column in bold; set-up and steps of the
   * finest run apart.
   */
  Table cost_at_equal_error(const CaseRuns &runs, const std::vector<double> &wanted);

  /** The least relative error of every method within the same CPU seconds; no value where
   * its coarsest run takes longer. */
  Table error_at_equal_cost(const CaseRuns &runs);
} // namespace meltfront::verification

#endif
