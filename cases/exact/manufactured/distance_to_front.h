#ifndef meltfront_cases_exact_manufactured_distance_to_front_h
#define meltfront_cases_exact_manufactured_distance_to_front_h

#include <cases/exact/manufactured/front_family.h>

namespace meltfront::cases::manufactured
{
  /**
   * Signed distance (m) from a place to the front of a family, negative in the solid.
   *
   * Newton's method along the gradient, in short steps, finds a place on the front; from
   * there the foot slides along the front to where it is nearest around, and Newton's
   * method on y - x + mu grad f(y) = 0, f(y) = 0 finishes. As there may be other places
   * as near, the same is begun anew from where, on the sphere through the foot found, the
   * level set is lowest, until nothing nearer turns up. Where the gradient vanishes, as
   * at a saddle or a centre, nothing divides by it: growing spheres give the beginnings.
   *
   * The foot is exact to round-off (1e-13 of the domain's diameter). That it is the
   * nearest of several is not proven but tested (4800 random places within the domain,
   * against the nearest of many places on the front). The front counts also beyond the
   * domain.
   *
   * @throws NumericalError where no front is found within four diameters of the domain
   */
  double distance_to_front(const FrontFamily &family, const Position &position,
                           double time);
} // namespace meltfront::cases::manufactured

#endif
