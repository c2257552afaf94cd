#ifndef meltfront_verification_report_chapters_chapters_h
#define meltfront_verification_report_chapters_chapters_h

#include <verification/report/page/case_runs.h>
#include <verification/report/page/markup.h>
#include <verification/report/plots/method_styles.h>
#include <verification/report/plots/plot_folder.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What every chapter of the report is made from. */
  struct ReportContext
  {
    const MatrixResult &result;
    std::vector<CaseRuns> runs;       ///< one per case as written, in the matrix's order
    std::vector<CaseRuns> variations; ///< one per varied case
    MethodStyles styles;
    PlotFolder plots;
    std::string directory;

    /** All labels in the matrix's order. */
    std::vector<std::string> labels() const;
  };

  /** A chapter of the page. */
  struct Chapter
  {
    const char *anchor;
    const char *word;                                ///< in the navigation
    Markup (*content)(const ReportContext &context); ///< empty: nothing is to be shown
  };

  /** What stands above all chapters. */
  Markup verdict_chapter(const ReportContext &context);

  /** What the first screen tells beside the verdict: the cheapest for relative errors
   * over all cases, what does not hold, failed, was refused, ended early or was left out;
   * empty where no run has a relative error. */
  Markup glance(const ReportContext &context);

  /** The matrix's findings and its pictures, and maps of what it varies; empty where it
   * has none of them. */
  Markup findings_chapter(const ReportContext &context);

  /** One table for each case that is varied: errors, orders, warnings of every
   * combination; empty where none is. */
  Markup variations_chapter(const ReportContext &context);

  /** The cheapest method for wanted errors, and all work-precision diagrams. */
  Markup cost_chapter(const ReportContext &context);

  /** What the methods answer to each question about a scene, with error bars, who agrees
   * with whom, and the cheapest for wanted errors; of a report on one case. */
  Markup answers_chapter(const ReportContext &context);

  /** How often the true error lies within the error bar; empty without exact solution. */
  Markup coverage_chapter(const ReportContext &context);

  /** Orders of time schemes and of elements by degree, over all cases; empty where no
   * label refines time or sets a degree. */
  Markup orders_chapter(const ReportContext &context);

  /** The reference run of a case without exact solution and how far it can be trusted:
   * finest three values, observed order, Richardson's limit, error bar. */
  Markup reference_of_case(const ReportContext &context, const CaseRuns &runs);

  /** Case by label: held, refused or failed; empty without verdicts. */
  Markup stability_chapter(const ReportContext &context);

  /** What `meltfront ablate` wrote to the directory: the changes without each effect;
   * empty where it did not run. */
  Markup ablation_chapter(const ReportContext &context);

  /** Case by effect: on or off, and its share of the time. */
  Markup effects_chapter(const ReportContext &context);

  /** The chapter of a case, whatever its kind of problem. */
  Markup case_chapter(const ReportContext &context, const CaseRuns &runs);

  /** Of a particle solid: frames, what many runs say together, solid particles over time,
   * energy over the time step. */
  Markup solid_chapter(const ReportContext &context, const CaseRuns &runs);

  /** Of a front that is carried along: fronts over the exact ones, errors, orders. */
  Markup advected_chapter(const ReportContext &context, const CaseRuns &runs);

  Markup provenance_chapter(const ReportContext &context);

  /** Reasons and costs of the effects in one case's runs. */
  Markup effects_of_case(const ReportContext &context, const CaseRuns &runs);

  /** The acceptance criteria that were held against runs: of one case, or of all if the
   * name is empty. */
  Markup criteria_table(const std::vector<CriterionResult> &criteria, bool with_case);

  /** Why a criterion fails within its bounds, and what is known of its failure. */
  std::string remarks_on(const CriterionResult &criterion);

  /** The bounds of a criterion: `19.7 to 20.7`, `≥ 0.09`. */
  Markup bound_of(const CriterionResult &criterion, int digits = 3);

  /** Where a case's section is in the page: `case-NAME`. */
  std::string case_anchor(const std::string &name);

  /** The case's name, linked to its section. */
  Markup case_link(const std::string &name);

  Markup badge(const std::string &kind, const std::string &words);

  /** Write DIR/tables/NAME.csv, and link to it: to the data itself, so that the page
   * suffices, and to the file beside the page. */
  Markup linked_csv(const ReportContext &context, const std::string &name,
                    const std::string &csv);

  /** Profiles of temperature and solid fraction, and of an alloy's concentration too, at
   * the intermediate times and at the end. */
  Markup profiles_of_case(const ReportContext &context, const CaseRuns &runs);
} // namespace meltfront::verification

#endif
