#ifndef meltfront_verification_report_tables_ensemble_table_h
#define meltfront_verification_report_tables_ensemble_table_h

#include <verification/report/page/case_runs.h>
#include <verification/report/tables/table.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A quantity over the seeds of one label and n. */
  struct EnsembleRow
  {
    std::string quantity;
    std::string meaning;                                ///< one clause
    double printed = 0;                                 ///< NaN: no paper prints it
    double mean = 0, deviation = 0, standard_error = 0; ///< NaN for less than two runs
    int runs = 0;                                       ///< that have the quantity
    /** The criterion on it, where there is one. */
    const CriterionResult *criterion = nullptr;

    /** By how many standard deviations the printed value lies above the mean; NaN where
     * runs do not differ. */
    double printed_deviation() const;
  };

  /** The rows of one label and n. */
  struct EnsembleGroup
  {
    std::string label; ///< `greenspan, n = 28`
    std::vector<EnsembleRow> rows;
  };

  /**
   * What many runs of a particle solid say together: of every label and n one row for
   * each of cases::reported_scalars() and for the solid particles at the intermediate
   * times and at the end that has a value. Of particles one by one, and of everything
   * where there are several labels, only what a criterion or a printed value asks for.
   */
  std::vector<EnsembleGroup> ensemble(const MatrixResult &result, const CaseRuns &runs);

  /** With badges; columns without any value are left out. */
  Markup ensemble_markup(const std::vector<EnsembleGroup> &groups);

  /** The same for Markdown and TeX. */
  Table ensemble_table(const std::vector<EnsembleGroup> &groups);

  /** All columns, 12 significant digits. */
  std::string ensemble_csv(const std::vector<EnsembleGroup> &groups);

  /** `PASS`, `FAIL`, or nothing without a criterion. */
  std::string verdict_of(const EnsembleRow &row);

  /** A particle and in how many runs it is fluid at the end. */
  struct FluidParticle
  {
    int particle = 0; ///< from 1
    int runs = 0;
    double share = 0;
  };

  /** Most often fluid first; those that never are left out. */
  std::vector<FluidParticle> fluid_particles(const Level &level);
} // namespace meltfront::verification

#endif
