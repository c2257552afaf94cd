#ifndef meltfront_verification_judge_ladder_h
#define meltfront_verification_judge_ladder_h

#include <verification/judge/error_bar.h>
#include <verification/judge/matrix_result.h>

#include <cstdint>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** The finished runs of one label and seed at a case, coarse to fine, each at a spacing
   * (or time step) of its own. */
  struct Ladder
  {
    std::string case_name, label, method;
    std::uint64_t seed = 1;
    std::vector<const RunRecord *> levels;
    bool in_time = false;       ///< its levels differ in time step only
    bool finest_failed = false; ///< a finer one was refused or failed
    /** One of the levels and a run that differs from it by about half the time step only;
     * null where there is none. */
    const RunRecord *whole_step = nullptr, *half_step = nullptr;
  };

  /** All ladders of a result that have a finished run, in the order of the runs. A label
   * of one run that halves the step of another label's level is that ladder's half_step
   * and none of its own. */
  std::vector<Ladder> ladders_of(const MatrixResult &result);

  /** Whether the steps of its two finest levels were refined so little with space that
   * the highest order of its errors cannot be believed: a run at half the step would
   * tell more. False for one level. */
  bool hides_time_error(const Ladder &ladder);

  /** A quantity of a run with its error bar. */
  struct QuantityBar
  {
    /** `front` (m), `front over time` (m; a root mean square: only its bar tells),
     * `solid_volume`, `heat`, `temperature at x = 0.25` (K), all of the end. */
    std::string quantity;
    ErrorBar bar;
    double exact = cases::nan; ///< NaN where it is unknown
    double scale = cases::nan; ///< size of the quantity, of temperatures their range
    double error = cases::nan; ///< true error; NaN where that is unknown
  };

  /** The name of the quantity that is the course of the front, not its end. */
  inline constexpr const char *front_course = "front over time";

  /** Steps in time of a run, one at the least. */
  double steps_of(const RunRecord &run);

  /**
   * Every quantity of the finest level with its bar (error_bar()), from the finest three
   * of the levels. Those that no level has are left out: `front` where the front is not
   * at one coordinate, `heat` of a method that keeps no book.
   *
   * Differences over time are root mean squares over 96 times between 5 per cent of the
   * common duration and its end (for values at the end over their second half), read by
   * cubics in sqrt(t); those of temperatures over all places, for the width over the
   * places within a tenth of the length. The error of the time step is that of half_step,
   * if its whole_step is one of the two finest levels used.
   */
  std::vector<QuantityBar> bars_of(const Ladder &ladder);

  /** Root mean square over the times above of the difference of two runs' courses; NaN
   * where one has none. */
  double course_difference(const RunRecord &one, const RunRecord &other,
                           std::vector<double> RunSeries::*quantity);
} // namespace meltfront::verification

#endif
