#ifndef meltfront_verification_run_timed_repeat_h
#define meltfront_verification_run_timed_repeat_h

#include <cases/case.h>
#include <cases/method.h>
#include <verification/record/run_record.h>

namespace meltfront::verification
{
  /** Add what a solution took to the times of a record, and keep the least of each part
   * of its cost. */
  void add_repeat(RunRecord &record, const cases::Cost &cost);

  /** Solve a case for its time alone: nothing is observed. */
  cases::Cost timed_solution(const cases::Case &c, const cases::Method &method,
                             const cases::Resolution &resolution);

  /** Runs that take longer (CPU s) are not repeated. */
  inline constexpr double longest_repeated = 10;

  /**
   * One repeat of a finished run by the protocol of careful timing, added to its record.
   * The first one takes the place of the times that the run itself had. The first
   * solution of a process pays for what is loaded and touched for the first time (4 ms of
   * finite elements): below 0.2 s it is not counted but made once more. Runs below 1 ms
   * are solved again and again until about 20 ms are over, and the mean counts.
   */
  void repeat_carefully(const cases::Case &c, const cases::Method &method,
                        const cases::Resolution &resolution, RunRecord &record);
} // namespace meltfront::verification

#endif
