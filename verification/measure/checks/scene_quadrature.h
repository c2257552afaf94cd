#ifndef meltfront_verification_measure_checks_scene_quadrature_h
#define meltfront_verification_measure_checks_scene_quadrature_h

#include <cases/scene.h>

#include <functional>
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
   * line, 16 along each direction of the plane, 64 around, 8 in space; one in each of the
   * simplices that a mesh's cells are divided into; none for other shapes.
   * @param divisions of these cells along every direction, a power of two */
  std::vector<QuadraturePoint> points_over(const cases::Domain &domain,
                                           int divisions = 1);

  /** Points over a wall: two in each of 256 cells on a box's in the plane, of 16 along
   * each direction of one in space, 64 around a round one, one on each edge or triangle
   * of a mesh's; none for walls of other shapes. */
  std::vector<QuadraturePoint> points_on(const cases::Domain &domain, cases::Side side,
                                         int divisions = 1);

  /** The mean distance of such points along the domain's side (m). */
  double point_distance_over(const cases::Domain &domain);

  /** The same of points on walls, or around a round wall of the domain's radius. */
  double point_distance_on_walls(const cases::Domain &domain);

  /** Integral of a field at a time (s). */
  double integral(const std::vector<QuadraturePoint> &points, const cases::Field &field,
                  double time);

  /**
   * Points so dense that halving their distance changes the field's integral by no more
   * than two hundredths of that of its magnitude, at times over the scene: what methods
   * sample of a field at their own places is off by as much.
   *
   * @param points by divisions, as above
   * @return none if some 70000 do not do: the field varies faster than they see
   */
  std::vector<QuadraturePoint> resolving_points(
      const std::function<std::vector<QuadraturePoint>(int divisions)> &points,
      const cases::Field &field, double start, double end);
} // namespace meltfront::verification

#endif
