#ifndef meltfront_particles_level_set_front_measures_h
#define meltfront_particles_level_set_front_measures_h

#include <particles/level_set/exact_fronts.h>
#include <particles/level_set/level_set.h>

namespace meltfront::particles::level_set
{
  /** How a level set's phase, phi > 0 by bilinear or trilinear interpolation, differs
   * from a reference shape, counted over samples (m^2, m^3). */
  struct ShapeDifference
  {
    double content = 0;   ///< area or volume of the level set's phase
    double reference = 0; ///< of the shape, over the same samples
    double missing = 0;   ///< of the shape without the phase
    double extra = 0;     ///< of the phase outside the shape

    /** Area of the symmetric difference over the shape's area. */
    double mismatch() const
    {
      return (missing + extra) / reference;
    }
  };

  /**
   * Compare over `samples` samples per cell and direction, at the centres of equal parts
   * of the cell. Only cells near one of the two fronts are sampled, of all others the
   * middle counts.
   *
   * @param samples the usual numbers are 10 in the plane, 4 in space
   */
  ShapeDifference shape_difference(const LevelSet &level_set, const ReferenceShape &shape,
                                   int samples);

  /** Mean distance between the two fronts over the spacing: symmetric difference over the
   * shape's border, the "L1 error". */
  double front_error(const ShapeDifference &difference, const ReferenceShape &shape,
                     const Grid &grid);

  /** Relative error of the area or volume by the shape's own. */
  double content_error(const ShapeDifference &difference, const ReferenceShape &shape);

  /** Area or volume where phi > 0, over samples as above (m^2, m^3). */
  double content(const LevelSet &level_set, int samples);

  /** Errors of normals and curvature at the points where the front cuts the grid's
   * edges. */
  struct FrontNoise
  {
    double normal = 0;      ///< root mean square of the angle between normals (degrees)
    double curvature = 0;   ///< root mean square of curvature/exact curvature - 1
    std::size_t points = 0; ///< that counted
  };

  /** @param exact nothing where a point shall not count */
  FrontNoise front_noise(const LevelSet &level_set, const ExactFrontFunction &exact);
} // namespace meltfront::particles::level_set

#endif
