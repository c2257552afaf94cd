#ifndef meltfront_verification_run_front_frame_h
#define meltfront_verification_run_front_frame_h

#include <cases/snapshot.h>
#include <verification/record/run_record.h>

#include <vector>

namespace meltfront::verification
{
  /**
   * Append a frame with the points that a snapshot holds on its front, at most 400,
   * evenly chosen; in 3D those of the layer nearest z = 0. Nothing is appended for sites
   * on a line and for a method that does not track its front.
   *
   * @param spacing of the sites (m)
   */
  void add_front_frame(const cases::Snapshot &snapshot, double spacing,
                       std::vector<FrontFrame> &frames);
} // namespace meltfront::verification

#endif
