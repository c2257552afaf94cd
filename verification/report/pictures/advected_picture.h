#ifndef meltfront_verification_report_pictures_advected_picture_h
#define meltfront_verification_report_pictures_advected_picture_h

#include <verification/record/run_record.h>
#include <verification/record/stored_case.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * A script that draws the domain in equal axes, the exact fronts of the case as lines
   * (one colour for each time, black for the end), and points that a run found on its
   * front in the colour of their time.
   */
  std::string advected_interface_script(const StoredCase &record,
                                        const std::vector<FrontFrame> &found);

  /** The times of the exact fronts: `0.5, 1`. */
  std::string advected_interface_times(const StoredCase &record);
} // namespace meltfront::verification

#endif
