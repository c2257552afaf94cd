#ifndef meltfront_verification_run_run_one_h
#define meltfront_verification_run_run_one_h

#include <cases/case.h>
#include <cases/method.h>
#include <verification/record/run_record.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace meltfront::verification
{
  /** How often a run is repeated for its timing. */
  struct RepeatPolicy
  {
    int most = 5;             ///< runs in all; 1: no repeat
    double short_run = 0.5;   ///< only runs below this are repeated (wall s)
    double total_seconds = 2; ///< no further repeat once so much is spent (wall s)
  };

  /** The label of a run with all options at their defaults, of one thread on one rank:
   * the method's name. Else `sph[step_factor=1.1]`, `sph[step_factor=1.1,threads=2]`. */
  std::string run_label(const std::string &method,
                        const std::map<std::string, std::string> &set_options,
                        int threads, int ranks = 1);

  /** The option by which a method is told its number of steps, `steps`, or the least
   * number, `fewest_steps`; empty where it has neither. */
  std::string steps_option(const cases::Options &options);

  /** Makes an observer that stands before another. */
  using ThroughObserver
      = std::function<std::unique_ptr<cases::Observer>(cases::Observer &)>;

  /**
   * Run one method on one case and measure it.
   *
   * The effects that the scene calls for are derived, the scene is reduced to them, and
   * the method solves it while a RunObserver observes it. A refusal gives a record of
   * status `refused`, any other exception one of status `failed`, with the reason;
   * nothing is thrown. A short run is repeated and the least of each time kept.
   *
   * Peak memory is that of the calling process (getrusage), or of one that it started and
   * that took more, so that it is the run's own where the process was started for it.
   *
   * @param label as run_label() gives it
   * @param provenance is copied to the record and completed by the case's text and hash,
   * the date and what build_provenance() knows
   * @param second an observer of the same run, e.g. a writer of fields, or null
   * @param through makes what the method hands its states to, which hands them on to the
   * observer that it gets; none: the observer itself. Only the first solution goes
   * through it
   */
  RunRecord run_one(const cases::Case &c, const cases::Method &method,
                    const cases::Resolution &resolution, const std::string &label,
                    const std::map<std::string, std::string> &provenance,
                    cases::Observer *second = nullptr, const RepeatPolicy &repeats = {},
                    const ThroughObserver &through = {});

  /** A record of that run which holds no result yet: status failed, no message. */
  RunRecord empty_record(const cases::Case &c, const cases::Method &method,
                         const cases::Resolution &resolution, const std::string &label,
                         const std::map<std::string, std::string> &provenance);
} // namespace meltfront::verification

#endif
