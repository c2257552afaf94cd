#ifndef meltfront_reference_fem_cut_front_speed_h
#define meltfront_reference_fem_cut_front_speed_h

#include <reference_fem/cut/cut_geometry.h>
#include <reference_fem/cut/level_set.h>

#include <vector>

namespace meltfront::reference_fem::cut
{
  /** The speed of the front as a field about it. */
  struct SpeedField
  {
    Values values;          ///< at the level set's degrees of freedom (m/s)
    std::vector<char> band; ///< by degree of freedom: whether the field reaches there
    double largest = 0;     ///< magnitude, in the cells that the front cuts (m/s)
  };

  /**
   * Take the speed off the front, constant along its normals: the linear or quadratic
   * element V with
   *
   *   int_front (V v + smoothing h^2 V' v') + h int_band dV/dn dv/dn
   *     = int_front speed v   for all v,
   *
   * V' along the front. The second term tames the shortest waves of the front, whose
   * speed explicit steps would overshoot; it vanishes where the speed is constant and is
   * of the order of the linear elements' own error elsewhere.
   *
   * @param speed by point of the front (m/s)
   */
  SpeedField extend_speed(const BackgroundMesh &mesh, const CutGeometry &geometry,
                          const Values &level_set, const std::vector<double> &speed,
                          double smoothing);
} // namespace meltfront::reference_fem::cut

#endif
