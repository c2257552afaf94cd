#ifndef meltfront_cases_sampling_h
#define meltfront_cases_sampling_h

#include <cases/position.h>
#include <cases/scene.h>

#include <functional>

namespace meltfront::cases
{
  /** Points of a line of samples along each direction of a domain's bounding box. */
  inline constexpr int samples_across = 33;

  using PointVisitor = std::function<void(const Position &)>;

  /** Whether a point between the corners of a domain's bounding box lies in it, its walls
   * included. */
  bool contains(const Domain &domain, const Position &p);

  /** Visit the sample points that lie in a domain, those on its walls included, and
   * points along an outline or the vertices of a mesh; of a shell those on circles or
   * spheres between its walls, however thin it is. */
  void visit_points(const Domain &domain, const PointVisitor &visit);

  /** Visit the sample points of a wall, at which a value that varies along it is to be
   * taken: of a round one some hundreds in all directions, however narrow it is. */
  void visit_wall(const Domain &domain, Side side, const PointVisitor &visit);
} // namespace meltfront::cases

#endif
