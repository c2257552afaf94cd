#ifndef meltfront_verification_judge_matrix_result_h
#define meltfront_verification_judge_matrix_result_h

#include <cases/numbers.h>
#include <verification/judge/finding.h>
#include <verification/measure/formulas/grid_convergence.h>
#include <verification/record/run_record.h>
#include <verification/record/stored_case.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A criterion held against the runs. */
  struct CriterionResult
  {
    std::string case_name;
    std::string method;
    std::string
        quantity; ///< `front_rms at n=40`, `order of front_rms`, `worst budget_defect`
    double value = 0; ///< NaN where the run is missing or failed
    double lower = 0, upper = 0;
    bool passed = false;
    std::string expected_failure;
    /** Why it fails although its value is within the bounds: an order whose fit is
     * oscillating, a reference that is not known well enough; else empty. */
    std::string remark{};
  };

  /** A criterion on the worst of the cases of a family (in_family()). */
  struct FamilyCriterion
  {
    std::string family;
    cases::Criterion criterion;
  };

  /** A figure that a run of a hard case is judged by; NaN passes nothing. */
  struct StabilityMeasure
  {
    std::string name;
    double value = 0;
    double bound = 0; ///< largest value that passes

    /** How near the value is to its bound, above 1 beyond it. */
    double share() const;
  };

  /** How a run of a hard case is judged (judge_stability()). */
  struct StabilityVerdict
  {
    std::string case_name;
    std::string label;
    int n = 0;
    std::string verdict; ///< `held`, `caught`, `refused` or `failed`
    std::string reason;  ///< of all but `held`, one sentence
    /** Of a run that finished, what decided first: by share(), descending. */
    std::vector<StabilityMeasure> measures{};
  };

  /** How far a value of a case's reference run can be trusted. */
  struct ReferenceTrust
  {
    std::string case_name;
    std::string label;
    std::string quantity;
    std::string symbol;           ///< `h`, or `dt` where the label's runs refine time
    std::vector<int> n;           ///< finest first, at most three; so are the other two
    std::vector<double> abscissa; ///< h (m) or dt (s)
    std::vector<double> values;
    GridConvergence convergence; ///< NaN for fewer than three
    /** The error bar of the finest value as of any other run (error_bar()); NaN for one
     * run. */
    double bar = cases::nan;
  };

  /** A matrix that ran (or is running): what summary.json and the report are made of. */
  struct MatrixResult
  {
    std::string name;
    std::string title;
    std::string description;
    std::string date;
    std::string program_version;
    bool hard_cases = false;       ///< the report shows the table held / refused / failed
    std::vector<StoredCase> cases; ///< in the matrix's order
    std::vector<RunRecord> runs;   ///< in the matrix's order
    std::vector<FamilyCriterion> family_criteria; ///< beside those of the cases
    std::vector<CriterionResult> criteria;
    std::vector<Finding> claims;         ///< findings as the matrix states them
    std::vector<FindingResult> findings; ///< the same, held against the runs
    std::vector<Picture> pictures;
    std::vector<ReferenceTrust> references;  ///< of cases that name a reference run
    std::vector<StabilityVerdict> stability; ///< of a matrix of hard cases, else empty
    std::vector<std::string>
        omissions; ///< runs that failed or were left out, each with its reason
    std::vector<std::string> remarks{}; ///< on how it was planned
    bool passed = false;
  };
} // namespace meltfront::verification

#endif
