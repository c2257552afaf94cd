#ifndef meltfront_cases_domain_measure_h
#define meltfront_cases_domain_measure_h

#include <cases/scene.h>

namespace meltfront::cases
{
  /** Volume of a domain in its own measure: length, area, volume (m, m^2, m^3). */
  double volume_of(const Domain &domain);

  /** Area of a wall in the same measure: 1 of a slab's end, length in the plane, area in
   * space. */
  double area_of(const Domain &domain, Side side);
} // namespace meltfront::cases

#endif
