#ifndef meltfront_verification_measure_checks_scene_quadrature_h
#define meltfront_verification_measure_checks_scene_quadrature_h

#include <cases/scene.h>

#include <vector>

namespace meltfront::verification
{
  /** A point and the length, area or volume that it stands for. */
  struct QuadraturePoint
  {
    cases::Position place{};
    double weight = 0;
  };

  /** Length of a slab, area of a domain of the plane, volume of one in space. */
  double volume_of(const cases::Domain &domain);

  /** 1 of a slab's wall, length of one in the plane, area of one in space. */
  double area_of(const cases::Domain &domain, cases::Side side);

  /** Points over a slab, a box, a disk or an annulus, two in each of 256 cells along a
   * line, 16 along each direction of the plane, 64 around, 8 in space; none for other
   * shapes. */
  std::vector<QuadraturePoint> points_over(const cases::Domain &domain);

  /** Points over a wall: 32 on a box's in the plane, 64 around a round one; none for
   * walls of other shapes. */
  std::vector<QuadraturePoint> points_on(const cases::Domain &domain, cases::Side side);
} // namespace meltfront::verification

#endif
