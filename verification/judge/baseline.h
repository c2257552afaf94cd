#ifndef meltfront_verification_judge_baseline_h
#define meltfront_verification_judge_baseline_h

#include <verification/judge/matrix_result.h>

#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What is kept of the runs of a case, label and n, over all seeds. */
  struct BaselineRuns
  {
    std::string
        status; ///< the worst: finished, refused or failed; of a hard case its verdict
    double cpu_seconds = 0; ///< of all; machines differ, so that it is not compared
    /** Errors and counts of work by name, each the worst: what must not grow. */
    std::map<std::string, double> figures;
  };

  /** What is kept of a criterion or a finding. */
  struct BaselineCriterion
  {
    std::string case_name; ///< empty for a finding
    std::string method;
    std::string quantity; ///< of a finding its claim
    double value = 0;
    bool passed = false;
  };

  /** Figures of a matrix that later runs of it are held against. */
  struct Baseline
  {
    std::string matrix;
    std::string program_version;
    std::map<std::string, BaselineRuns> runs; ///< by `CASE/LABEL/n=N`
    std::vector<BaselineCriterion> criteria;
  };

  Baseline baseline_of(const MatrixResult &result);

  /** Write it as JSON with a line for each run and criterion, sorted, figures to four
   * digits and seconds to two, so that a change in the repository shows what changed.
   * @throws cases::OutputError */
  void write_baseline(const std::string &path, const Baseline &baseline);

  /** @throws cases::OutputError for a file that cannot be read or is none. */
  Baseline read_baseline(const std::string &path);

  /** How a matrix differs from what it was. */
  struct BaselineComparison
  {
    long runs = 0, figures = 0, criteria = 0; ///< compared
    /** Figures that grew, runs that end worse, criteria that held and do not hold, and
     * what is missing; one line each. */
    std::vector<std::string> flags;
    /** What is there now and was not, and figures that fell as much; one line each. */
    std::vector<std::string> notes;
  };

  /**
   * Hold a matrix against its baseline. A figure grew if it is more than `tolerance`
   * above what it was and is no round-off: errors below ten times round_off_floor() are
   * equal.
   *
   * @param result of the matrix now, whose cases tell where round-off begins
   */
  BaselineComparison compare_with_baseline(const MatrixResult &result,
                                           const Baseline &was, double tolerance = 0.1);

  /** The comparison for a terminal. */
  std::string comparison_text(const BaselineComparison &comparison);
} // namespace meltfront::verification

#endif
