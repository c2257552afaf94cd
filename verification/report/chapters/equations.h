#ifndef meltfront_verification_report_chapters_equations_h
#define meltfront_verification_report_chapters_equations_h

#include <verification/record/stored_case.h>
#include <verification/report/page/markup.h>

namespace meltfront::verification
{
  /**
   * What is solved, with the case's numbers filled in: the heat equation of each phase,
   * the Stefan condition at the front, sources, walls and the initial state.
   */
  Markup equations(const StoredCase &record);

  /** Properties of the two phases, with diffusivities and ratios. */
  Markup material_table(const StoredCase &record);
} // namespace meltfront::verification

#endif
