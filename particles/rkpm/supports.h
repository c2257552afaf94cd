#ifndef meltfront_particles_rkpm_supports_h
#define meltfront_particles_rkpm_supports_h

#include <particles/core/particle_storage.h>

#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm
{
  /** How wide a support is. */
  enum class SupportRule
  {
    fixed_dilation,    ///< dilation = alpha times the particle spacing
    nearest_neighbours ///< the n nearest; dilation = distance of the next one
  };

  struct SupportSettings
  {
    SupportRule rule = SupportRule::nearest_neighbours;
    double alpha = 0;   ///< dilation over spacing, for fixed_dilation
    double spacing = 0; ///< mean particle spacing (m), for fixed_dilation
    int neighbours = 0; ///< n, the point's own particle counted; 0: twice the number of
                        ///< basis functions
  };

  /** By how much a support grows in one enlargement: a fixed dilation by this factor, n
   * neighbours by half a basis. */
  inline constexpr double enlargement_factor = 1.2;

  /** The particles nearer to each point than its dilation, ascending in each row. */
  struct Supports
  {
    std::vector<std::size_t> offsets;
    std::vector<std::uint32_t> neighbours;
    std::vector<double> dilation; ///< of each point (m)

    std::size_t rows() const
    {
      return dilation.size();
    }

    std::span<const std::uint32_t> operator[](std::size_t row) const
    {
      return {neighbours.data() + offsets[row], offsets[row + 1] - offsets[row]};
    }
  };

  /**
   * Supports of points among particles, found on cells: the cost is linear where the
   * density of particles varies little.
   * @param basis_size number of basis functions
   * @param enlargements how often each point's support has been enlarged
   * @throws cases::InputError for a fixed dilation that is not positive, or for fewer
   *         particles than neighbours wanted.
   */
  Supports find_supports(const ParticleStorage &points, const ParticleStorage &particles,
                         const SupportSettings &settings, int basis_size,
                         std::span<const int> enlargements);

  /**
   * Supports of the particles where each particle's own dilation decides whom it reaches:
   * row a holds the particles b with |x_a - x_b| < dilation_b.
   */
  Supports reach_of_neighbours(const ParticleStorage &particles,
                               std::span<const double> dilations);
} // namespace meltfront::particles::rkpm

#endif
