#ifndef meltfront_cases_exact_one_phase_start_h
#define meltfront_cases_exact_one_phase_start_h

#include <cases/exact/oracle.h>

#include <memory>

namespace meltfront::cases
{
  /**
   * The solution of a problem that starts with one phase throughout (no initial fronts),
   * solid or liquid as OracleProblem::solid_at_origin says, which its walls, of any kind,
   * freeze or melt from one side or both: OnsetLayer where a wall sets off or a phase
   * appears, SpectralOracle between. A wall that never passes the melting temperature
   * leaves the phase as it is.
   *
   * Walls and initial temperature must agree with each other, unless that is uniform:
   * then a wall may set off at once, by a jump or a kink.
   *
   * @throws InputError for a problem that is incomplete or inconsistent, or has unequal
   * densities.
   * @throws NumericalError as SpectralOracle.
   */
  std::shared_ptr<const LayeredSolution>
  solve_from_one_phase(const OracleProblem &problem);
} // namespace meltfront::cases

#endif
