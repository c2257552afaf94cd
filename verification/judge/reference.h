#ifndef meltfront_verification_judge_reference_h
#define meltfront_verification_judge_reference_h

#include <verification/judge/matrix_result.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Whether a quantity is a difference from a reference run. */
  bool is_derived_quantity(const std::string &name);

  /** Whether others of the case are held against this run. */
  bool is_reference(const StoredCase &record, const RunRecord &run);

  /**
   * Hold the runs of every case that names a reference (Case::reference) against that
   * run; adds to RunRecord::quantities, NaN where not defined and for the reference run
   * itself:
   *
   * X_error = |X - X_ref| for every X with Quantity::compared;
   * X_bars = X_error over the error bar of X_ref from the three finest runs of the
   * reference's label, itself the finest (error_bar()): at or below 1, the reference
   * cannot tell the run from itself;
   * solid_volume_rms_error: root mean square over the run's series, at least 50 times, of
   * the difference from the reference's series at these times, which is interpolated.
   *
   * Fills MatrixResult::references and appends to `omissions` what could not be compared:
   * a reference that is missing, or with too few coarser runs for its uncertainty.
   */
  void compare_with_references(MatrixResult &result);
} // namespace meltfront::verification

#endif
