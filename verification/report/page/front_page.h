#ifndef meltfront_verification_report_page_front_page_h
#define meltfront_verification_report_page_front_page_h

#include <verification/judge/matrix_result.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What came of one matrix of several. */
  struct MatrixLine
  {
    std::string matrix, title;
    std::string link; ///< to its report, from the page's own directory
    bool passed = false;
    long criteria = 0, held = 0;
    /** Criteria that do not hold and findings that the figures do not bear, each with
     * what is known of it. */
    std::vector<std::string> failed;
    long finished = 0, refused = 0, broken = 0; ///< runs
    double cpu_seconds = 0;                     ///< of the runs
  };

  /** @param link to the matrix's report */
  MatrixLine matrix_line(const MatrixResult &result, const std::string &link);

  /** `default   PASSED  103 of 103 criteria   230 runs, 94 s`, and a line for each that
   * does not hold. */
  std::string line_text(const MatrixLine &line);

  /** Write PATH, the page before the reports of several matrices: a row for each.
   * @throws cases::OutputError */
  void write_front_page(const std::vector<MatrixLine> &lines, const std::string &path);
} // namespace meltfront::verification

#endif
