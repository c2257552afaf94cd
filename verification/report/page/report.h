#ifndef meltfront_verification_report_page_report_h
#define meltfront_verification_report_page_report_h

#include <verification/judge/matrix_result.h>

#include <string>

namespace meltfront::verification
{
  /**
   * Write the report of a matrix: DIR/report.html (one file that needs no other and no
   * network), DIR/tables/CASE.{csv,md,tex} and DIR/plots/NAME.svg. Runs nothing; works
   * with whatever runs there are, none included. The chapter on hard cases stands where
   * MatrixResult::stability has verdicts.
   *
   * @throws cases::OutputError if gnuplot is missing or a file cannot be written.
   */
  void write_report(const MatrixResult &result, const std::string &directory);

  /**
   * Write what a single run leaves behind beside its record: DIR/front.csv (`time, front,
   * front_isotherm, front_exact, budget_defect`) and DIR/picture.svg: the last state, as
   * sites in the plane where the run has them, else as temperature over the coordinate.
   *
   * @throws cases::OutputError as write_report().
   */
  void write_run_page(const RunRecord &run, const StoredCase &record,
                      const std::string &directory);
} // namespace meltfront::verification

#endif
