#ifndef meltfront_verification_report_page_case_runs_h
#define meltfront_verification_report_page_case_runs_h

#include <verification/judge/matrix_result.h>
#include <verification/judge/refinement.h>

#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A quantity over seeds. */
  struct SeedMean
  {
    double mean = 0;
    double spread = 0; ///< sample standard deviation; 0 for a single seed
    int count = 0;     ///< finished runs that have the quantity
  };

  /** The runs of one case, label and n: one per seed. */
  struct Level
  {
    int n = 0;
    std::vector<const RunRecord *> runs;
    const RunRecord *finished = nullptr; ///< the first that finished, if any
    int finished_count = 0;
    /** Over the finished runs: all RunRecord::quantities and run_columns() that are
     * finite. */
    std::map<std::string, SeedMean> values;

    /** The mean of a quantity; NaN where no finished run has it. */
    double value(const std::string &quantity) const;
    double spread(const std::string &quantity) const;

    /** `finished`, `refused`, `failed`, or `2 of 3 finished`. */
    std::string status() const;
  };

  /** The runs of one case and label, coarse to fine. */
  struct LabelRuns
  {
    std::string label;
    std::vector<Level> levels;
    Refinement refinement; ///< of h or of dt

    /** The finished run of the largest n; null if none finished. */
    const RunRecord *finest() const;

    /** In which its runs are simulated. */
    int dimension() const;

    /** A quantity at every level that has it, over h or dt. */
    ErrorLevels errors(const std::string &quantity) const;
  };

  struct CaseRuns
  {
    const StoredCase *record = nullptr;
    std::vector<LabelRuns> labels; ///< in the matrix's order

    const LabelRuns *find(const std::string &label) const;

    /** The finished run of the largest n among all labels that has a front; null if none.
     */
    const RunRecord *finest() const;

    /** True if some finished run has a finite value of the quantity. */
    bool has(const std::string &quantity) const;
  };

  /** Whether a case is about a particle solid. */
  bool moves_particles(const StoredCase &record);

  /** Whether a case is about a front that a velocity carries along. */
  bool carries_front(const StoredCase &record);

  /** Whether no time passes in a case. */
  bool steady(const StoredCase &record);

  /** The exact front at the end time (m); NaN where there is none. */
  double exact_front_at_end(const StoredCase &record);

  /** The distance of that front from where it set out or its radius; of one that has no
   * single position the radius of a disk or ball of the exact solid's volume (m). */
  double front_size_at_end(const StoredCase &record);

  /** The dimensions that the labels of a case run in, ascending. */
  std::vector<int> dimensions_of(const CaseRuns &runs);

  /** The error that a case is judged by: `front_rms`; where there is no exact solution
   * `solid_volume_end_error`; of a front that is carried along `shape_mismatch_end`; of a
   * particle solid `energy_error`. */
  std::string main_error(const StoredCase &record);

  /** The error that its diagrams show: the same, or `consensus_error` where
   * collect_runs() has given its levels one. */
  std::string main_error(const CaseRuns &runs);

  /** Its value at a level. Of a run with too few times for a mean of the front's error
   * the largest stands, which bounds it. */
  double shown_error(const Level &level, const CaseRuns &runs);

  /** What it is relative to: front_size_at_end(), or the reference's solid
   * volume there; 1 for what is relative already; NaN where there is nothing. */
  double main_error_scale(const CaseRuns &runs);

  CaseRuns collect_runs(const MatrixResult &result, const StoredCase &record);

  /** Of a single case without exact solution and reference, levels have a
   * `consensus_error`: level_errors(), relative. */
  std::vector<CaseRuns> collect_runs(const MatrixResult &result);

  /** CPU seconds of set-up and stepping. */
  double cpu_seconds(const RunRecord &run);

  /**
   * True if the front is a circle or a sphere about the origin: in a cylindrical or
   * spherical scene, and in one without symmetry whose exact solution is not planar.
   */
  bool radial_front(const StoredCase &record);

  /** ` Restates FIGURE.` where the plot of that name restates a printed one, else
   * nothing. */
  std::string restated(const StoredCase &record, const std::string &figure);

  /** The unit of the solid's volume: m, m² or m³. */
  std::string volume_unit(const StoredCase &record);

  /** A unit, or nothing for a case in normalised quantities. */
  std::string unit_of(const StoredCase &record, const std::string &unit);
} // namespace meltfront::verification

#endif
