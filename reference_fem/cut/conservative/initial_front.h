#ifndef meltfront_reference_fem_cut_conservative_initial_front_h
#define meltfront_reference_fem_cut_conservative_initial_front_h

#include <reference_fem/cut/conservative/bodies.h>
#include <reference_fem/cut/conservative/step_frame.h>

#include <functional>

namespace meltfront::reference_fem::cut::conservative
{
  /**
   * The front of a level set of any kind, of which only sign and zeros matter: both are
   * found on triangles divided 64 times, and nodes get their distances to those zeros. A
   * chord of a curved front cuts off what it bulges by; so these are fitted to the
   * solid's area in each hat, by the law of the front without any heat,
   *
   *   A(phi; w) = A(divided; w) + smoothing(w).
   *
   * That is the minimum of a convex function (FrontMove), so that Newton's method with a
   * search along its steps finds it. What it leaves over is debt.
   *
   * @throws std::runtime_error for a front that no triangle's corners see
   */
  FrontState initial_front(const TriangleMesh &mesh,
                           const std::function<double(const Point &)> &level_set,
                           double reach);

  /** The front of a frame fitted so to the solid's area by hat; without heat. */
  FrontState fitted_front(const TriangleMesh &mesh, const StepFrame &frame,
                          const Values &solid_area, double reach);
} // namespace meltfront::reference_fem::cut::conservative

#endif
