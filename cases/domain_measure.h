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

  /**
   * The fewest equal cells along Domain::side() of which every other side is a whole
   * number, too: 3 in a box of 0.06 m by 0.04 m. Resolutions for which a lattice fills
   * the domain are its multiples. 1 where that is the case for all, and where no number
   * up to a thousand is found.
   */
  int fewest_whole_cells(const Domain &domain);
} // namespace meltfront::cases

#endif
