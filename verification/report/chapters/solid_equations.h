#ifndef meltfront_verification_report_chapters_solid_equations_h
#define meltfront_verification_report_chapters_solid_equations_h

#include <verification/record/stored_case.h>
#include <verification/report/page/markup.h>

namespace meltfront::verification
{
  /**
   * How the particles of a solid are moved, with the case's numbers: leapfrog, forces,
   * base and source by their numbers in D. Greenspan, A particle model of the Stefan
   * problem, 1976; what is solid; where the particles start.
   */
  Markup solid_equations(const StoredCase &record);

  /** A front that a velocity carries along: the level set's equation, region, velocity,
   * times. */
  Markup advection_equations(const StoredCase &record);
} // namespace meltfront::verification

#endif
