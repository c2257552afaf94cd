#ifndef meltfront_verification_app_console_h
#define meltfront_verification_app_console_h

#include <cases/case.h>
#include <verification/judge/matrix_result.h>

#include <string>

namespace meltfront::verification
{
  /**
   * What a matrix has shown, for a terminal: the verdict and what does not hold; verdicts
   * on hard cases; one line per case and method with the finest front error, the fitted
   * order and its cost. Verdicts are coloured where standard output is a terminal and
   * NO_COLOR is not set.
   *
   * @param details every criterion with its figure, findings, and what was left out
   */
  std::string console_summary(const MatrixResult &result, bool details);

  /** What one run did: scheme, effects on and off with their reasons, results, cost. */
  std::string run_text(const RunRecord &record, const cases::Case &c);
} // namespace meltfront::verification

#endif
