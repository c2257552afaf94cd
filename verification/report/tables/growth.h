#ifndef meltfront_verification_report_tables_growth_h
#define meltfront_verification_report_tables_growth_h

#include <verification/measure/formulas/order_fit.h>
#include <verification/report/page/case_runs.h>
#include <verification/report/tables/table.h>

#include <vector>

namespace meltfront::verification
{
  /** The exponent p of amount ~ size^p, as fit_order() fits it, with its 95 % confidence.
   * Costs may grow as they like: the verdict is clean for four sizes or more that have an
   * amount. */
  OrderFit fit_growth(const std::vector<double> &sizes,
                      const std::vector<double> &amounts);

  /**
   * How steps, work and the processor time of stepping grow with the number of unknowns
   * N over the finest four sizes of every label that has four, beside theory: a step
   * whose effort is proportional to N gives N^(1 + k/d) in d dimensions where the method
   * took steps ~ h^-k. k is that of the label's own steps between its two finest levels,
   * as a whole number where it is one to within 0.15.
   */
  Table growth_table(const std::vector<CaseRuns> &cases);
} // namespace meltfront::verification

#endif
