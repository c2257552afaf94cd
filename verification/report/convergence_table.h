#ifndef meltfront_verification_report_convergence_table_h
#define meltfront_verification_report_convergence_table_h

#include <verification/measure/order_fit.h>
#include <verification/report/case_runs.h>
#include <verification/report/table.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What a column of the convergence table holds. */
  struct Quantity
  {
    std::string name; ///< in RunRecord::quantities, run.json and the CSV
    std::string heading;
    std::string unit;
    bool error = false;   ///< it has an order, and its least value is the best
    bool whole = false;   ///< a count
    bool special = false; ///< in the table only if the case asks for it; last in the CSV
  };

  /** The columns of convergence tables in their order, with units of SI. */
  const std::vector<Quantity> &table_quantities();

  /** The heading of a quantity; its name if it is none of the table's columns. */
  std::string quantity_heading(const std::string &name);

  /**
   * The order of a quantity over the levels that have it, by fit_order(). An order over
   * fewer than four levels is given in OrderFit but is not printed by order_cell().
   */
  OrderFit order_of(const LabelRuns &runs, const std::string &quantity);

  /** `h^1.57 +- 0.05`, or a dash where the order says nothing. */
  Cell order_cell(const OrderFit &fit, const std::string &base = "h");

  /** One row per n and a last row of fitted orders, for every label; columns without any
   * value are left out. */
  Table convergence_table(const CaseRuns &runs);

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
