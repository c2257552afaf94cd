#ifndef meltfront_verification_matrix_progress_h
#define meltfront_verification_matrix_progress_h

#include <verification/matrix/time_estimate.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * Tells how far a matrix is: one line that changes in place on a terminal, one line for
   * each run that ends elsewhere. The time left is guessed from the measured times of the
   * runs that have ended (TimeEstimate), and of earlier calls. Refused runs are told at
   * the end, once for each reason.
   */
  class Progress
  {
  public:
    /**
     * @param out null for none
     * @param runs that are to be made
     * @param finished_before runs of an earlier call that count as done
     * @param jobs runs at once
     */
    Progress(std::FILE *out, std::vector<RunKind> runs, std::size_t finished_before,
             int jobs);

    /** Ends the line that changes in place. */
    ~Progress();

    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    /** A run has ended after so many seconds: `what` names it, `how` says how it went. */
    void run_ended(const RunKind &run, double seconds, const std::string &what,
                   const std::string &how, bool well);

    /** What a run took another time (s). */
    void expect(const RunKind &run, double seconds);

    /** A run was refused for a reason, a sentence. */
    void run_refused(const RunKind &run, const std::string &reason);

    /** Show which runs go on; at most four times a second, on a terminal only. */
    void show_running(const std::string &what);

    /** Seconds until all runs that have not ended would have, each begun anew; NaN as
     * long as nothing is known. */
    double seconds_left() const;

  private:
    struct Refusals
    {
      int runs = 0;
      std::vector<std::string> cases;
    };

    std::string time_left() const;
    void count(const RunKind &run);

    std::FILE *out;
    bool terminal;
    int jobs;
    std::size_t ended = 0;
    std::vector<RunKind> waiting; ///< or running
    TimeEstimate estimate;
    std::map<std::string, Refusals> refusals; ///< by reason
    std::chrono::steady_clock::time_point last_ended, last_shown;
  };

  /** `8 s`, `3 min 20 s`, `2 h 5 min`. */
  std::string time_left_text(double seconds);
} // namespace meltfront::verification

#endif
