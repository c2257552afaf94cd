#ifndef meltfront_verification_report_chapters_alloy_equations_h
#define meltfront_verification_report_chapters_alloy_equations_h

#include <verification/record/stored_case.h>
#include <verification/report/page/markup.h>
#include <verification/report/tables/table.h>

namespace meltfront::verification
{
  /** What is solved of an alloy: heat, enthalpy, the lever rule, conductivity, solutes,
   * the eutectic, with the case's numbers filled in. */
  Markup alloy_equations(const StoredCase &record);

  /** Rows for the solutes and the crystals in the table of the material. */
  void add_alloy_properties(const StoredCase &record, RowGroup &group);
} // namespace meltfront::verification

#endif
