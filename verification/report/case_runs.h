#ifndef meltfront_verification_report_case_runs_h
#define meltfront_verification_report_case_runs_h

#include <verification/matrix/matrix_result.h>

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
  };

  /** The runs of one case, label and n: one per seed. */
  struct Level
  {
    int n = 0;
    std::vector<const RunRecord *> runs;
    const RunRecord *finished = nullptr; ///< the first that finished, if any
    int finished_count = 0;
    /**
     * Over the finished runs: all RunRecord::quantities that are finite, and `h`,
     * `unknowns`, `steps`, `cpu_seconds` (set-up and stepping), `wall_seconds`,
     * `peak_memory_mb`, `work`.
     */
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

    /** The finished run of the largest n; null if none finished. */
    const RunRecord *finest() const;

    /** A quantity at every level that has it, with the h of the level. */
    void finite_values(const std::string &quantity, std::vector<double> &h,
                       std::vector<double> &values) const;
  };

  struct CaseRuns
  {
    const CaseRecord *record = nullptr;
    std::vector<LabelRuns> labels; ///< in the matrix's order

    const LabelRuns *find(const std::string &label) const;

    /** The finished run of the largest n among all labels that has a front; null if none.
     */
    const RunRecord *finest() const;

    /** True if some finished run has a finite value of the quantity. */
    bool has(const std::string &quantity) const;
  };

  CaseRuns collect_runs(const MatrixResult &result, const CaseRecord &record);

  std::vector<CaseRuns> collect_runs(const MatrixResult &result);

  /** CPU seconds of set-up and stepping. */
  double cpu_seconds(const RunRecord &run);

  /** The length that n divides: slab length, box side or ball diameter (m). */
  double domain_side(const CaseRecord &record);

  /** The method of a label: what stands before the first `[`. */
  std::string method_of(const std::string &label);

  /**
   * True if the front is a circle or a sphere about the origin: in a cylindrical or
   * spherical scene, and in one without symmetry whose exact solution is not planar.
   */
  bool radial_front(const CaseRecord &record);

  /** A unit, or nothing for a case in normalised quantities. */
  std::string unit_of(const CaseRecord &record, const std::string &unit);
} // namespace meltfront::verification

#endif
