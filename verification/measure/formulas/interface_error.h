#ifndef meltfront_verification_measure_formulas_interface_error_h
#define meltfront_verification_measure_formulas_interface_error_h

#include <cases/scene.h>
#include <cases/snapshot.h>

#include <array>
#include <limits>

namespace meltfront::verification
{
  /** How a level set's region differs from the exact one; NaN where that is not known. */
  struct InterfaceErrors
  {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    double volume = unknown;    ///< region's area or volume over the exact one, less 1
    double front = unknown;     ///< symmetric difference over the front's length, over h
    double mismatch = unknown;  ///< symmetric difference over the exact region's volume
    double missing = unknown;   ///< of the exact region, over its volume
    double extra = unknown;     ///< outside the exact region, over its volume
    double normal = unknown;    ///< root mean square angle between normals (degrees)
    double curvature = unknown; ///< root mean square of curvature over the exact one, - 1
  };

  /**
   * Compares a front that is carried along with the region that the velocity really
   * carries: a point is inside at a time if its path, followed back, started inside.
   *
   * Regions are compared over samples at the centres of equal parts of the cells of a
   * grid of the run's spacing: 10 along a side in the plane, 4 in space, where a cell is
   * cut by the level set or near the exact front; elsewhere one sample tells all. Where
   * the motion is rigid, or has brought everything back, the exact region is the initial
   * one at its place. Else in the plane it is what exact_front_pieces() enclose; in space
   * it is not known, and only the volume is compared, with that at the start (no
   * velocity here has a divergence in space).
   */
  class InterfaceComparison
  {
  public:
    /**
     * @param scene of ProblemKind::interface_advection, outlives it
     * @param spacing of the run (m)
     */
    InterfaceComparison(const cases::Scene &scene, double spacing);

    /** All errors of a state that has a level set. */
    InterfaceErrors errors(const cases::Snapshot &snapshot) const;

    /** Area or volume of the region where the level set is positive (m^2, m^3). */
    double volume(const cases::Snapshot &snapshot) const;

  private:
    const cases::Scene &scene;
    double spacing;
  };
} // namespace meltfront::verification

#endif
