#ifndef meltfront_particles_greenspan_sphere_shadows_h
#define meltfront_particles_greenspan_sphere_shadows_h

#include <particles/greenspan/shadows.h>

namespace meltfront::particles::greenspan
{
  /** Centres of spheres, coordinate by coordinate. */
  using Centres = std::array<std::span<const double>, 3>;

  /**
   * Light from a point of space on spheres of equal radius, each in the shadow of those
   * whose centres are nearer to the source. A sphere at distance d spans a cap of
   * directions within asin(radius / d) of its centre's; `width` is the solid angle of the
   * part of it that no nearer one spans, `share` that over the solid angle of the cap. A
   * sphere that contains the source gets all and hides all farther ones.
   *
   * The part is a region of the unit sphere between arcs of small circles, and its area
   * the sum over these of sectors and spherical triangles (Gauss and Bonnet; the
   * triangles by van Oosterom and Strackee 1983): exact to 1e-7 of a cap for spheres that
   * do not overlap, where an order by distance is that in which a ray meets them. A
   * sphere that is hidden whole hides nothing that others do not; the others are found in
   * a tree, so that the cost grows as n log n.
   *
   * @throws cases::InputError for a radius that is not positive
   */
  std::vector<Exposure> exposure_to_point(const Centres &centres,
                                          const std::array<double, 3> &source,
                                          double radius);

  /**
   * The same in parallel rays along a direction of any length but zero: `width` is the
   * area across the rays that nothing in front covers.
   * @throws cases::InputError for a direction of no length
   */
  std::vector<Exposure> exposure_to_rays(const Centres &centres,
                                         const std::array<double, 3> &direction,
                                         double radius);
} // namespace meltfront::particles::greenspan

#endif
