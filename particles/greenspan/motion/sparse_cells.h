#ifndef meltfront_particles_greenspan_motion_sparse_cells_h
#define meltfront_particles_greenspan_motion_sparse_cells_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::greenspan
{
  /** Rows of particles in one array, in any order. */
  struct FoundRows
  {
    std::vector<std::size_t> first;    ///< of each particle's row, in `entries`
    std::vector<std::uint32_t> length; ///< of it
    std::vector<std::uint32_t> entries;

    std::span<const std::uint32_t> operator[](std::size_t particle) const
    {
      return {entries.data() + first[particle], length[particle]};
    }

    std::span<std::uint32_t> operator[](std::size_t particle)
    {
      return {entries.data() + first[particle], length[particle]};
    }
  };

  /**
   * The particles nearer to each than a radius, not itself, in no particular order. Only
   * cells that hold particles are kept, so that drops that fly far away cost no more than
   * others.
   * @param position of which the first n are looked at, 2 or 3 coordinates
   */
  FoundRows find_in_cells(int dimension,
                          const std::array<std::vector<double>, 3> &position,
                          std::size_t n, double radius);

  /** The same among all pairs. */
  FoundRows find_among_all(int dimension,
                           const std::array<std::vector<double>, 3> &position,
                           std::size_t n, double radius);
} // namespace meltfront::particles::greenspan

#endif
