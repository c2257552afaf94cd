#ifndef meltfront_reference_fem_cut_conservative_initial_front_h
#define meltfront_reference_fem_cut_conservative_initial_front_h

#include <reference_fem/cut/conservative/bodies.h>

#include <functional>

namespace meltfront::reference_fem::cut::conservative
{
  /**
   * The front of a level set of any kind, of which only sign and zeros matter. A chord of
   * a curved front cuts off what it bulges by; so the level set is fitted to the solid's
   * area in each hat, by the law of the front without any heat,
   *
   *   A(phi; w) = A(exact; w) + smoothing(w),
   *
   * A(exact; w) on triangles divided 64 times. What Newton's method leaves over is debt.
   */
  FrontState initial_front(const TriangleMesh &mesh,
                           const std::function<double(const Point &)> &level_set,
                           double reach);
} // namespace meltfront::reference_fem::cut::conservative

#endif
