#ifndef meltfront_particles_level_set_extension_h
#define meltfront_particles_level_set_extension_h

#include <particles/level_set/level_set.h>

#include <optional>

namespace meltfront::particles::level_set
{
  /**
   * Carries a quantity of the front, as its speed, out into the band so that it does not
   * change along normals: grad V . grad phi = 0 (Adalsteinsson and Sethian 1999). Nodes
   * next to the front take the value of their closest point on it; all others, the
   * nearest first, take the mean of their neighbours nearer to the front that one-sided
   * differences give. First order; constants exactly.
   */
  class Extension
  {
  public:
    /**
     * @param at_front the quantity, asked at points of the front
     * @param result along the band of a level set that is a distance
     */
    void operator()(const LevelSet &level_set, const ScalarFunction &at_front,
                    std::span<double> result);

  private:
    /** A node of the band, the nearest to the front first. */
    struct Place
    {
      double distance;    ///< |phi|
      std::size_t node;   ///< in the grid
      std::size_t number; ///< in the band

      auto operator<=>(const Place &) const = default;
    };

    /** Nothing where no neighbour is nearer: in a dent of phi that is no distance. */
    std::optional<double> from_nearer(const LevelSet &level_set, std::size_t node) const;

    std::vector<Place> order;
    std::vector<double> values;     ///< at all nodes; only those that are done count
    std::vector<std::uint8_t> done; ///< of all nodes; zero between calls
  };

  /**
   * Velocities that move the front along its outward normals, speed times
   * -grad phi/|grad phi|; zero where phi has no slope.
   *
   * @param speed along the band, positive where the phase with phi > 0 grows (m/s)
   * @param velocity along the band, one array per dimension (m/s)
   */
  void normal_velocities(const LevelSet &level_set, std::span<const double> speed,
                         const std::array<std::span<double>, 3> &velocity);
} // namespace meltfront::particles::level_set

#endif
