#ifndef meltfront_verification_report_tables_step_cost_h
#define meltfront_verification_report_tables_step_cost_h

#include <verification/report/page/case_runs.h>
#include <verification/report/tables/table.h>

namespace meltfront::verification
{
  /**
   * What a step costs: processor time of stepping over steps, by label and n, beside that
   * of the case's first label at the same n, and the exponent of n that it grows with,
   * fitted over at least four n.
   */
  Table step_cost_table(const CaseRuns &runs);
} // namespace meltfront::verification

#endif
