#ifndef meltfront_verification_report_pictures_tracked_front_h
#define meltfront_verification_report_pictures_tracked_front_h

#include <verification/report/page/case_runs.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Of the finest runs of all labels, the one that kept the most points of its front;
   * null if none kept any. */
  const RunRecord *tracked_run(const CaseRuns &runs);

  /**
   * Add the points of some frames to a script as data.
   *
   * @return what to plot: earlier frames in grey, the last in black
   */
  std::vector<std::string> write_tracked_fronts(std::string &script,
                                                const std::vector<FrontFrame> &frames);
} // namespace meltfront::verification

#endif
