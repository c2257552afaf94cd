#ifndef meltfront_verification_matrix_workers_h
#define meltfront_verification_matrix_workers_h

#include <verification/matrix/job.h>
#include <verification/matrix/progress.h>
#include <verification/matrix/run_claim.h>
#include <verification/run/child_process.h>

#include <chrono>
#include <deque>
#include <filesystem>
#include <optional>
#include <vector>

namespace meltfront::verification
{
  /**
   * Starts runs, watches them and writes down how they end. Other processes may be at
   * work on the same runs: each is made by who claims it (RunClaim), and waited for by
   * the others.
   */
  class Workers
  {
  public:
    /** @param time_limit of one run (wall s)
     * @param since runs of other processes count as made from then on */
    Workers(const RunnerOptions &options, double time_limit,
            std::filesystem::file_time_type since, Progress &progress);

    /** Returns when all runs have ended, here or elsewhere. */
    void run(std::deque<Job> jobs);

  private:
    using Clock = std::chrono::steady_clock;

    struct RunningJob
    {
      Job job;
      std::optional<RunClaim> claim; ///< none where a launched process claims it
      ChildProcess process;
      Clock::time_point start;
    };

    int slots_of(const Job &job) const;
    void start_what_fits();
    void start(Job job);
    ChildProcess made_here(const Job &job) const;
    ChildProcess launched(const Job &job) const;
    bool ended(RunningJob &running_job);
    void end_launched(RunningJob &running_job, const std::string &problem);
    void record_failure(const Job &job, const std::string &problem,
                        double peak_memory_mb);
    void report(const Job &job, double seconds);
    void look_elsewhere();
    void show();

    /** s; no process holds a claim longer than a run may take. */
    double stale_after() const;

    const RunnerOptions &options;
    double time_limit;
    std::filesystem::file_time_type since;
    Progress &progress;
    std::deque<Job> waiting;
    std::vector<RunningJob> running;
    std::vector<Job> elsewhere; ///< claimed by other processes
    Clock::time_point looked{};
  };
} // namespace meltfront::verification

#endif
