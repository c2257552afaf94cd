#ifndef meltfront_verification_ranks_ranked_run_h
#define meltfront_verification_ranks_ranked_run_h

#include <cases/case.h>
#include <verification/ranks/method_on_ranks.h>
#include <verification/ranks/part_observer.h>
#include <verification/ranks/ranks.h>
#include <verification/record/run_record.h>
#include <verification/run/checkpoint/checkpoint_folder.h>

#include <map>
#include <optional>
#include <string>

namespace meltfront::verification
{
  /** Where a run keeps checkpoints, and goes on from the last one. */
  struct KeptRun
  {
    CheckpointFolder folder;
    double interval = 0; ///< s of wall time
  };

  /**
   * run_one() on all ranks of the session at the same time: one run, which they share,
   * and one record, on the first rank. Its processor times and peak memory are sums over
   * the ranks, its wall times those of the first.
   *
   * A run that fails on one rank only ends all: where the others cannot know of it within
   * ten seconds, that rank writes the record to `file`, says why and aborts.
   *
   * @param part observes the rank's parts of snapshots
   * @param time_limit wall seconds; 0: none
   * @param kept null: no checkpoints
   * @return the record; on other ranks than the first only its status
   */
  RunRecord run_on_ranks(const RankSession &session, const cases::Case &c,
                         const MethodOnRanks &method, const cases::Resolution &resolution,
                         const std::string &label,
                         const std::map<std::string, std::string> &provenance,
                         PartObserver &part, double time_limit, const std::string &file,
                         const std::optional<KeptRun> &kept);
} // namespace meltfront::verification

#endif
