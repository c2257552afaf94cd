#ifndef meltfront_verification_judge_stability_h
#define meltfront_verification_judge_stability_h

#include <verification/judge/matrix_result.h>

#include <vector>

namespace meltfront::verification
{
  /**
   * Judge every run of a matrix of hard cases, in the matrix's order.
   *
   * `held`: a run that finished with all of these within their bounds
   *
   * * what the harness checked at every snapshot (Check), the maximum principle and the
   *   balance of heat among it;
   * * the heat budget's defect, of methods that conserve heat, over the largest term
   *   of the budget or, if these sum to next to nothing, the magnitude of what is stored:
   * 1e-12, or half a unit of the last place times the number of steps or the contrast of
   * the conductivities (by which fluxes of the better conductor are rounded) if that is
   * more;
   * * how far the front fell back, where physics says that it does not: 1e-9 of the side;
   * * its error over the domain's side (or volume): of the front or, of a mush, of the
   *   solid's volume against the exact solution; of the temperature where no phase
   *   changes; where there is no exact solution, of the solid's volume against the other
   *   methods' median (MedianCourse). At most two spacings, and at most half of the way
   * that the front goes (a front that stays where it started is off by 0.58 of that or
   * more) unless that is less than a spacing, to which a front is known.
   *
   * `caught`: a run that was made to step at or beyond the stability limit with the guard
   * off (`step_limit = stability`, `step_factor` >= 1), and that a check ended; at the
   * limit, where nothing grows and nothing decays, also one that is found out here.
   *
   * `refused`: with its reason. `failed`: all else; so is a run beyond the limit that
   * returns a result, whatever that looks like.
   */
  std::vector<StabilityVerdict> judge_stability(const MatrixResult &result);

  /** Whether a measure is the run's error, rather than a check of what it must keep. */
  bool is_error(const StabilityMeasure &measure);
} // namespace meltfront::verification

#endif
