#ifndef meltfront_cases_exact_manufactured_front_area_h
#define meltfront_cases_exact_manufactured_front_area_h

#include <cases/exact/manufactured/front_family.h>

namespace meltfront::cases::manufactured
{
  /**
   * The area of a family's front within its domain (m^(d-1)): the volume of a layer about
   * it, weighed by a cosine of the distance f/|grad f|, over the layer's thickness, on
   * 160 (2D) or 48 (3D) cells along x. To about 1e-3 and 1e-2, where the front's radii of
   * curvature are some cells.
   */
  double front_area(const FrontFamily &family, double time);
} // namespace meltfront::cases::manufactured

#endif
