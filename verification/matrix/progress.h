#ifndef meltfront_verification_matrix_progress_h
#define meltfront_verification_matrix_progress_h

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

namespace meltfront::verification
{
  /**
   * Tells how far a matrix is: one line that changes in place on a terminal, one line for
   * each run that ends elsewhere. The time left is the time spent times the share of work
   * left, with the runs' own estimates of their work.
   */
  class Progress
  {
  public:
    /**
     * @param out null for none
     * @param runs that are to be made
     * @param work of all of them, in any unit
     * @param finished_before runs of an earlier call that count as done
     */
    Progress(std::FILE *out, std::size_t runs, double work, std::size_t finished_before);

    /** Ends the line that changes in place. */
    ~Progress();

    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    /** A run has ended: `what` names it, `how` says how it went. */
    void run_ended(const std::string &what, const std::string &how, bool well,
                   double work);

    /** Show which runs go on; at most four times a second, on a terminal only. */
    void show_running(const std::string &what);

  private:
    std::string time_left() const;

    std::FILE *out;
    bool terminal;
    std::size_t runs;
    std::size_t ended = 0;
    double work;
    double work_done = 0;
    std::chrono::steady_clock::time_point start, last_shown;
  };

  /** `8 s`, `3 min 20 s`, `2 h 5 min`. */
  std::string time_left_text(double seconds);
} // namespace meltfront::verification

#endif
