#ifndef meltfront_verification_measure_formulas_front_displacement_h
#define meltfront_verification_measure_formulas_front_displacement_h

#include <cases/exact_solution.h>
#include <cases/snapshot.h>

namespace meltfront::verification
{
  /** By how much the solid found differs from the exact one, over the area of the exact
   * front (m). */
  struct FrontDisplacement
  {
    double mean = 0;     ///< (V - V_exact) / A: too much solid is positive
    double mismatch = 0; ///< integral of |solid fraction - exact one| over A
  };

  /**
   * How far the front of a solution that depends on more than one coordinate is from
   * where it should be. A site stands for a cube of its volume; of one that the exact
   * front cuts the exact solid fraction is sampled at 16 x 16 (8 x 8 x 8) points.
   */
  FrontDisplacement front_displacement(const cases::Snapshot &snapshot,
                                       const cases::ExactSolution &exact);
} // namespace meltfront::verification

#endif
