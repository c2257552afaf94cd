#ifndef meltfront_cases_exact_manufactured_distance_to_front_h
#define meltfront_cases_exact_manufactured_distance_to_front_h

#include <cases/exact/manufactured/front_family.h>

namespace meltfront::cases::manufactured
{
  /**
   * Signed distance (m) from a place to the front of a family, negative in the solid.
   *
   * A first foot on the front is found by Newton's method along the gradient in short
   * steps; further ones on rays in all directions that meet the front sooner. Each is
   * then drawn to the nearest place on the front around it by Newton's method on y - x +
   * mu grad f(y) = 0, f(y) = 0. No step divides by a gradient without looking at it, and
   * a step that leads away, as near a saddle, is not taken: the foot stays on the front.
   *
   * Exact to round-off near the front, and wherever the nearest foot is clearly the
   * nearest. Where two are almost equally far, the further one may be given: too large by
   * at most 2 % (16 rays) in two and 10 % (26 rays) in three dimensions.
   *
   * @throws NumericalError where no front is met within the domain's diameter
   */
  double distance_to_front(const FrontFamily &family, const Position &position,
                           double time);
} // namespace meltfront::cases::manufactured

#endif
