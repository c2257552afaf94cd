#ifndef meltfront_verification_report_chapters_case_parts_h
#define meltfront_verification_report_chapters_case_parts_h

#include <verification/report/chapters/chapters.h>

#include <string>

namespace meltfront::verification
{
  // Parts that the chapters of all kinds of cases are made of.

  /** Two things side by side where there is room. */
  Markup pair(const Markup &left, const Markup &right, const std::string &kind = "pair");

  /** Behind a line that opens it; nothing for nothing. */
  Markup folded(const std::string &summary, const Markup &content);

  /** Name, tags, title and description of a case. */
  Markup chapter_head(const StoredCase &record);

  /** What each label's finest run was made with; nothing where no run finished. */
  Markup parameters(const CaseRuns &runs);

  /** The effects and the parameters, both folded. */
  Markup effects_and_parameters(const ReportContext &context, const CaseRuns &runs);

  /** The convergence table with its orders and its CSV. */
  Markup convergence(const ReportContext &context, const CaseRuns &runs);

  /** Error against spacing, time step and CPU time. */
  Markup error_plots(const ReportContext &context, const CaseRuns &runs);

  /** Printed numbers beside ours, with a heading; nothing where none is printed. */
  Markup printed(const ReportContext &context, const CaseRuns &runs);

  /** The case's acceptance criteria, with a heading; nothing without any. */
  Markup criteria(const ReportContext &context, const StoredCase &record);

  /** The case's limits, and its runs that did not finish with their reasons, equal ones
   * once. */
  Markup limits(const CaseRuns &runs);

  /** The section of a case. */
  Markup chapter_of(const StoredCase &record, const Markup &content);
} // namespace meltfront::verification

#endif
