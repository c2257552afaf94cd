#ifndef meltfront_verification_matrix_timing_rounds_h
#define meltfront_verification_matrix_timing_rounds_h

#include <verification/matrix/job.h>

#include <vector>

namespace meltfront::verification
{
  /**
   * Time the runs of a matrix carefully: those of one thread, of the first seed, that
   * finished within longest_repeated. Round after round each of them is repeated once, in
   * a process of its own and alone, so that a disturbance of the machine meets different
   * runs and not all repeats of one; until its times are settled(). Every repeat is in
   * the record as soon as it is made: killed, it goes on where it stopped.
   */
  void time_carefully(const std::vector<Job> &jobs, const RunnerOptions &options,
                      double time_limit);
} // namespace meltfront::verification

#endif
