#ifndef meltfront_verification_report_equations_h
#define meltfront_verification_report_equations_h

#include <verification/matrix/case_record.h>
#include <verification/report/markup.h>

namespace meltfront::verification
{
  /**
   * What is solved, with the case's numbers filled in: the heat equation of each phase,
   * the Stefan condition at the front, sources, walls and the initial state.
   */
  Markup equations(const CaseRecord &record);

  /** Properties of the two phases, with diffusivities and ratios. */
  Markup material_table(const CaseRecord &record);
} // namespace meltfront::verification

#endif
