#ifndef meltfront_verification_matrix_runner_h
#define meltfront_verification_matrix_runner_h

#include <verification/judge/matrix_result.h>
#include <verification/matrix/matrix.h>
#include <verification/run/run_one.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** How a matrix is run. */
  struct RunnerOptions
  {
    std::string directory; ///< results are written to it
    int jobs = 0;          ///< threads in use at once; 0: one for each core
    /** Most memory that a run may take (bytes); see cases::Resolution::memory_limit. */
    double memory_limit = std::numeric_limits<double>::infinity();
    std::string program_version;
    std::string program_hash; ///< empty: program_hash()
    std::string command_line;
    std::FILE *progress = nullptr; ///< null: say nothing
    RepeatPolicy repeats{};
    /** When runs that go on, and those that wait, are ended as by their time limit. */
    std::chrono::steady_clock::time_point deadline
        = std::chrono::steady_clock::time_point::max();
    /** Command that makes one run, whose identity is appended to it, in a process of its
     * own (with `only`), on whatever machine; empty: runs are made by forked processes
     * here. */
    std::vector<std::string> launcher{};
    /** The run that make_one_run() makes, as find_run() finds it. */
    std::string only{};
    /** Directory of records that several matrices share: one that another of them has
     * made is taken over and not made again; empty: none. */
    std::string shared{};
    /** What runs took another time (s), by their identity: for the time left. */
    std::map<std::string, double> known_seconds{};
    /** What is to be done with the result while the directory is held against other
     * processes: the report, for one. */
    std::function<void(MatrixResult &)> conclude{};
  };

  /**
   * Run a matrix and return what load_matrix_result() reads from its directory.
   *
   * Every run has a process of its own, the largest first, as many at once as `jobs`
   * allows (a run counts with its threads). It writes its record under a temporary name
   * and renames it. A run that crashes or exceeds the matrix's time limit is recorded as
   * failed with the reason; the others go on. One that is estimated to need more memory
   * than it may have is refused, one that comes to need more fails.
   *
   * Resumable: a record of the same case text, method, option values, n, seed, threads
   * and program is kept and not made again if the run finished, was refused, or failed by
   * itself (it would again). Runs that crashed, were killed or lacked memory, for which
   * the machine may be to blame, are made again; so is everything once the program or the
   * case has changed. Killed at any moment and called again, it loses and repeats nothing
   * that was finished.
   *
   * Several processes, on machines that share the folder, may run the same matrix in one
   * directory at once: each run is made by the process that claims it (RunClaim), all
   * wait for all runs, and each concludes from the same records.
   *
   * Written: matrix.json, cases/CASE.json, runs/CASE/LABEL/n=N/run.json (and run.log, if
   * the run printed something), runs.log with a line for each run made, summary.json.
   *
   * @param load_case is called once for each case as it is named, before any run
   * @throws InputError if a case or the matrix is wrong, before any run; OutputError if
   * the directory cannot be written to.
   */
  MatrixResult run_matrix(const Matrix &matrix, const RunnerOptions &options,
                          const CaseLoader &load_case, const MethodLookup &methods);

  /** Make one run of a matrix, `only`, and nothing else: no more than its record comes of
   * it, unless it has been made or another process makes it. What a launcher starts, or a
   * task of an array of batch jobs. @throws as run_matrix() */
  void make_one_run(const Matrix &matrix, const RunnerOptions &options,
                    const CaseLoader &load_case, const MethodLookup &methods);
} // namespace meltfront::verification

#endif
