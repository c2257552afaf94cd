#ifndef meltfront_verification_matrix_matrix_files_h
#define meltfront_verification_matrix_matrix_files_h

#include <verification/judge/matrix_result.h>
#include <verification/matrix/matrix.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * Write what is known before the first run: DIR/matrix.json (title, date, version,
   * the list of runs, criteria, findings and pictures) and DIR/cases/CASE.json. With it,
   * load_matrix_result() can read a matrix that is still running or was killed.
   */
  void write_plan(const std::string &directory, const Matrix &matrix,
                  const std::vector<StoredCase> &cases,
                  const std::vector<PlannedRun> &runs,
                  const std::string &program_version);

  /**
   * Write DIR/summary.json: `passed`, `criteria` (each with `case`, `method`, `quantity`,
   * `value`, `bound`, `passed`, `remark`, `expected_failure`; `bound` is a number where
   * one side is bounded, which one says `relation`, `<=` or `>=`; and [lower, upper] with
   * `in`), `findings` (each with `claim` and `holds`), `omissions`.
   */
  void write_summary(const std::string &directory, const MatrixResult &result);

  /** Read a matrix's directory back (DIR/matrix.json, DIR/cases, DIR/runs): nothing is
   * run. */
  MatrixResult load_matrix_result(const std::string &directory);
} // namespace meltfront::verification

#endif
