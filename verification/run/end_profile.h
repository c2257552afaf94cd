#ifndef meltfront_verification_run_end_profile_h
#define meltfront_verification_run_end_profile_h

#include <cases/exact_solution.h>
#include <cases/snapshot.h>
#include <verification/record/run_record.h>

#include <vector>

namespace meltfront::verification
{
  /**
   * What a record keeps of a state for plots: at most 600 sites along the coordinate, the
   * exact temperature beside them (NaN where it is not finite), and at most 6000 sites in
   * the plane, spread evenly: all sites in 2D, in 3D the layer nearest z = 0.
   *
   * @param coordinates of the sites (x or r, m)
   * @param exact or null
   * @param spacing of the sites (m)
   */
  RunProfile make_end_profile(const cases::Snapshot &snapshot,
                              const std::vector<double> &coordinates,
                              const cases::ExactSolution *exact, double spacing);
} // namespace meltfront::verification

#endif
