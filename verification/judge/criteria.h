#ifndef meltfront_verification_judge_criteria_h
#define meltfront_verification_judge_criteria_h

#include <verification/judge/matrix_result.h>

#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A quantity of a finished run, as a measure's or told from its cost; NaN for a run
   * that did not finish and for an unknown name. */
  double table_value(const RunRecord &run, const std::string &name);

  /** The quantities that are told from a run's cost, by name. */
  std::map<std::string, double> run_columns(const RunRecord &run);

  /** What a criterion asks of: `front_rms at n=40`, `order of front_rms`. */
  std::string quantity_text(const cases::Criterion &criterion);

  /** Why a matrix says nothing on a criterion in a case; empty if it does. */
  std::string why_not_judged(const MatrixResult &result, const StoredCase &record,
                             const cases::Criterion &criterion);

  /** A criterion held against the runs of a case. */
  struct Judgement
  {
    double value = 0;   ///< NaN where a run that it needs is missing or failed
    std::string remark; ///< as CriterionResult::remark
    bool passed = false;
  };

  /** Hold a criterion against the runs of a case, as evaluate() explains. */
  Judgement judge(const MatrixResult &result, const StoredCase &record,
                  const cases::Criterion &criterion);

  /**
   * Hold the criteria of every case of a matrix and its findings against its runs; fills
   * `criteria`, `findings` and `passed`, and appends to `omissions`.
   *
   * A criterion concerns the runs whose label is its method, options in brackets in any
   * order; without brackets, those with no option set by the matrix. One on
   * cases::any_method is judged for each label of the case by itself, but for those that
   * are refused or do not measure its quantity. Orders are over h,
   * or over dt where the runs refine that (Refinement), without levels at round-off
   * (round_off_floor()). One that asks for convergence, with a lower bound above zero,
   * fails where the fit is oscillating, stagnating, diverging or suspiciously fast. Runs
   * of several seeds count with the one that is furthest from the bounds, or least within
   * them
   * (`median`: that, `worst`: the largest); those of particle solids, whose seeds are one
   * ensemble, with their mean. A difference from a reference run is bounded in vain, and
   * fails, where the error bar of the reference exceeds the bound or is not known.
   * Refused runs are no part of an order or a worst value,
   * nor is a case's reference run of those of its own difference from itself. A criterion
   * is not judged, and listed as an omission, if the matrix has no such run: no run of
   * the method at its n, none at all for `worst`, fewer than four resolutions for an
   * order. A criterion of failure holds if all its runs ended with an error that the
   * method saw itself. Any other run that failed, was refused at the criterion's n or is
   * missing makes the value NaN, which does not pass.
   *
   * A criterion on a family is one on the case of it that falls furthest short of the
   * bound, or passes it by least, of those that the matrix has such runs of.
   *
   * `passed` asks that every criterion judged passes, that every finding holds, and that
   * no run failed that is not known to, or is missing.
   *
   * Omissions are the refused, failed and missing runs with their reasons, and the
   * criteria that were not judged.
   */
  void evaluate(MatrixResult &result);
} // namespace meltfront::verification

#endif
