#ifndef meltfront_verification_judge_stability_h
#define meltfront_verification_judge_stability_h

#include <verification/judge/matrix_result.h>

#include <vector>

namespace meltfront::verification
{
  /**
   * Judge every run of a matrix of hard cases, in the matrix's order.
   *
   * A run held when it ended with a finite state within the maximum principle (the
   * methods check both at every step), its worst heat budget defect is at most 1e-12, and
   * its front never moved back by more than 1e-9 of the domain's side in a case whose
   * physics says that it does not. A refusal must give its reason. A run beyond a
   * method's stability limit (`step_factor` above 1) that returns a result has failed,
   * whatever the result looks like; one that is caught on its way counts as refused.
   */
  std::vector<StabilityVerdict> judge_stability(const MatrixResult &result);
} // namespace meltfront::verification

#endif
