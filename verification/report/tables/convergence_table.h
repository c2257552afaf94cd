#ifndef meltfront_verification_report_tables_convergence_table_h
#define meltfront_verification_report_tables_convergence_table_h

#include <verification/measure/formulas/order_fit.h>
#include <verification/measure/measure.h>
#include <verification/report/page/case_runs.h>
#include <verification/report/tables/table.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** The columns of convergence tables in their order, with units of SI. */
  const std::vector<Quantity> &table_quantities();

  /** The heading of a quantity; its name if it is none of the table's columns. */
  std::string quantity_heading(const std::string &name);

  /**
   * The order of a quantity over the levels that have it, by fit_levels(): in h, or in dt
   * where the label refines that. An order over fewer than four levels is given in
   * OrderFit but is not printed by order_cell().
   */
  OrderFit order_of(const StoredCase &record, const LabelRuns &runs,
                    const std::string &quantity);

  /** `h^1.57 +- 0.05`, or a dash where the order says nothing; how many levels at
   * round-off were left out. */
  Cell order_cell(const OrderFit &fit, const std::string &base = "h");

  /** One row per n and a last row of fitted orders, for every label; columns without any
   * value are left out. */
  Table convergence_table(const CaseRuns &runs);

  /**
   * One row for each label with an order: that of front_end, front_rms and
   * temperature_l2 (of the solid's volume where there is no exact solution), its least
   * error, and what that cost.
   */
  Table orders_table(const CaseRuns &runs);

  /** The rates between neighbouring resolutions: a detail. */
  Table pairwise_table(const CaseRuns &runs);

  /**
   * Comma-separated values, one row per label and n, with all columns whether they hold
   * values or not (`nan`), 12 significant digits. The column `method` holds the label.
   */
  std::string convergence_csv(const CaseRuns &runs);

  /** Numbers printed in papers beside the measured ones: deviation in per cent, and the
   * order in n fitted to both. Empty when the case restates none. */
  Table printed_table(const CaseRuns &runs);

  std::string printed_csv(const CaseRuns &runs);

  /** A field of a CSV file, in quotes where it needs them. */
  std::string csv_field(const std::string &plain);
} // namespace meltfront::verification

#endif
