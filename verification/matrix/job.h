#ifndef meltfront_verification_matrix_job_h
#define meltfront_verification_matrix_job_h

#include <verification/matrix/matrix.h>
#include <verification/matrix/runner.h>
#include <verification/matrix/time_estimate.h>
#include <verification/record/run_record.h>

#include <filesystem>
#include <map>
#include <string>

namespace meltfront::verification
{
  /** A planned run with what is needed to make it. */
  struct Job
  {
    PlannedRun run;
    const cases::Case *the_case;
    const cases::Method *method;
    std::string path; ///< of its record
    double work;      ///< estimate, in any unit: the largest runs start first

    /** Of all that is stored of the run. */
    std::filesystem::path folder() const;

    /** The file that says which process makes it (RunClaim). */
    std::string claim() const;
  };

  /** What a record tells of the program that made it. */
  std::map<std::string, std::string> provenance_of(const RunnerOptions &options);

  RunRecord record_without_result(const Job &job, const RunnerOptions &options);

  /** Whether a record is that of the job and would come out the same again. */
  bool is_record_of(const RunRecord &record, const Job &job,
                    const RunnerOptions &options);

  /** Whether the run's record is there and would come out the same again. */
  bool already_made(const Job &job, const RunnerOptions &options);

  /** The same, or it was made after `since`, by whatever process and however it ended:
   * what the machine may have spoilt is tried once in a call. */
  bool made_since(const Job &job, const RunnerOptions &options,
                  std::filesystem::file_time_type since);

  /** Put a record among those that matrices share (RunnerOptions::shared), unless the
   * machine may have spoilt it. */
  void share(const Job &job, const RunnerOptions &options);

  /** Take the record over from those, whatever the label of the run there.
   * @return whether there was one */
  bool take_shared(const Job &job, const RunnerOptions &options);

  /** `CASE LABEL n=N`, with the seed where it is not 1. */
  std::string name_of(const Job &job);

  RunKind kind_of(const Job &job);
} // namespace meltfront::verification

#endif
