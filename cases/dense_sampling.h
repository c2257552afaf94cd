#ifndef meltfront_cases_dense_sampling_h
#define meltfront_cases_dense_sampling_h

#include <cases/sampling.h>
#include <cases/scene.h>

#include <functional>
#include <string>
#include <vector>

namespace meltfront::cases
{
  /**
   * Visit points of a scene's domain, those on its walls included, close enough to see
   * narrow features of some fields: one where no field varies in space; else along each
   * direction that any depends on, 4097 where that is one (or the distance from the
   * origin), 257 where there are two, 49 where there are three, and all numbers that the
   * expressions name, with the middles between them. Fields taken from an exact solution
   * are smooth but costly: the points of visit_points().
   */
  void visit_densely(const Scene &scene, const std::vector<const Field *> &fields,
                     const PointVisitor &visit);

  /** Whether a field may depend on a variable, a letter. One whose words name none, and
   * that is not constant, was made otherwise: it may depend on any. */
  bool may_vary_with(const Field &field, const std::string &variable);

  /** Whether a boundary prescribes its temperature or one beside it, other than an exact
   * solution's. */
  bool gives_temperature(const Boundary &boundary);

  /** The wall of a slab, a box or a body about an axis, as a domain without extent along
   * its normal. */
  Domain wall_of(const Domain &domain, Side side);

  /** Visit points of a wall as visit_densely() does, of a circle at 4097 angles,
   * of other walls that bend those of visit_wall(). */
  void visit_wall_densely(const Scene &scene, Side side, const Field &field,
                          const PointVisitor &visit);

  /** Called with a value at a position and a time. */
  using ValueVisitor = std::function<void(double)>;

  /**
   * Visit the values of a field on a wall over the run: at points of visit_wall() (one
   * where it does not vary in space) and at times up to 4097, fewer where the points are
   * many; on both sides of breakpoints; and at the extremes in time, which are searched
   * for between the samples. A wall in the plane has points in a row, as many as
   * visit_wall_densely() where the field is steady and 257 and those that it names where
   * not, and its extremes are searched for between them too.
   */
  void visit_wall_values(const Scene &scene, Side side, const Field &field,
                         const ValueVisitor &visit);

  /** The same of a field at given positions. */
  void visit_values_in_time(const Scene &scene, const Field &field,
                            const std::vector<Position> &positions,
                            const ValueVisitor &visit);

  /** The same of what is released throughout a scene's domain; at some points only where
   * that varies in space and time. */
  void visit_release(const Scene &scene, const ValueVisitor &visit);
} // namespace meltfront::cases

#endif
