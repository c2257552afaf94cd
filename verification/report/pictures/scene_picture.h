#ifndef meltfront_verification_report_pictures_scene_picture_h
#define meltfront_verification_report_pictures_scene_picture_h

#include <verification/report/page/case_runs.h>

#include <limits>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What is drawn inside the domain. */
  struct SceneContent
  {
    /** The run whose sites are drawn; null or without sites: the phases as areas. */
    const RunRecord *run = nullptr;
    double front = std::numeric_limits<double>::quiet_NaN(); ///< at the end; NaN: none
    std::vector<FrontFrame> tracked; ///< points on the front, the last ones in black
  };

  /**
   * A script that draws the scene in equal axes: the domain with its walls and what is
   * prescribed on them, its sources, the front at the end, a scale, and the particles of
   * a run, solid ones filled and liquid ones open.
   */
  std::string scene_picture_script(const StoredCase &record, const SceneContent &content);

  /** The run whose sites suit a picture: the finest one with few enough of them; null if
   * no run has any. */
  const RunRecord *run_to_picture(const CaseRuns &runs);

  /** The front at the end: the exact one, else that of the finest run; NaN for none. */
  double front_at_end(const CaseRuns &runs);
} // namespace meltfront::verification

#endif
