#ifndef meltfront_particles_core_particle_storage_h
#define meltfront_particles_core_particle_storage_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** Where particles are: a structure of arrays, one array per coordinate. */
  struct ParticleStorage
  {
    int dimension = 1;
    std::array<std::vector<double>, 3> position; ///< m; empty beyond the dimension

    std::size_t size() const
    {
      return position[0].size();
    }

    void add(const std::array<double, 3> &point);

    /** A particle's position, zero beyond the dimension. */
    std::array<double, 3> point(std::size_t particle) const;
  };

  /**
   * The order in which the particles lie along a Morton curve through cubes of the given
   * side: particles near each other in space come near each other in memory. Particles in
   * one cube keep their order.
   */
  std::vector<std::uint32_t> order_along_curve(const ParticleStorage &particles,
                                               double cube_side);

  /** Reorder the particles: new particle i is old particle order[i]. */
  void reorder(ParticleStorage &particles, std::span<const std::uint32_t> order);
} // namespace meltfront::particles

#endif
