#ifndef meltfront_particles_greenspan_shadows_h
#define meltfront_particles_greenspan_shadows_h

#include <array>
#include <span>
#include <vector>

namespace meltfront::particles::greenspan
{
  /** What a particle gets of a source's light. */
  struct Exposure
  {
    double share = 0; ///< of its disk's width that no other disk hides
    double width
        = 0; ///< what it catches: angle at a point source, width of parallel rays
  };

  /** @throws cases::InputError unless it is positive */
  void require_light_radius(double radius);

  /** Particles by their distance or depth, those of the same as they are given. */
  std::vector<std::size_t> order_of_light(const std::vector<double> &key);

  /**
   * Light from a point of the plane on disks of equal radius, each in the shadow of those
   * whose centres are nearer to the source. A disk at distance d spans the angles within
   * asin(radius / d) of its centre's; it is exposed where none of the nearer ones spans
   * them. A disk that contains the source gets all and hides all farther ones. Exact for
   * disks that do not overlap; O(n log n).
   *
   * @param radius of the disks: no more than half of a bond's length
   * @throws cases::InputError for a radius that is not positive
   */
  std::vector<Exposure> exposure_to_point(std::span<const double> x,
                                          std::span<const double> y,
                                          const std::array<double, 2> &source,
                                          double radius);

  /**
   * The same in parallel rays along a direction, of any length but zero.
   * @throws cases::InputError for a direction of no length
   */
  std::vector<Exposure> exposure_to_rays(std::span<const double> x,
                                         std::span<const double> y,
                                         const std::array<double, 2> &direction,
                                         double radius);
} // namespace meltfront::particles::greenspan

#endif
