#ifndef meltfront_verification_record_run_times_h
#define meltfront_verification_record_run_times_h

#include <vector>

namespace meltfront::verification
{
  /** What repeats of a run took, set-up and steps together: the record's cost has the
   * least of each part. */
  struct RunTimes
  {
    /** Whether the protocol of careful timing was followed: repeats in turn with other
     * runs until they are settled(). Else a short run was repeated a few times at once.
     */
    bool careful = false;
    std::vector<double> cpu, wall; ///< s, one for each repeat
  };

  /** Whether the three least processor times lie within a tolerance of the least; false
   * for fewer. */
  bool agree_within(const RunTimes &times, double tolerance);

  /** Whether no further repeat is wanted: at least five, and the three least agree within
   * 3 % or there are fifteen. */
  bool settled(const RunTimes &times);

  /** Whether the fastest repeat had to share its core: it took 1.2 times its processor
   * time or more. */
  bool disturbed(const RunTimes &times);
} // namespace meltfront::verification

#endif
