#ifndef meltfront_particles_greenspan_motion_neighbour_rows_h
#define meltfront_particles_greenspan_motion_neighbour_rows_h

#include <particles/greenspan/motion/periodic_space.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::greenspan
{
  /** Particles whose rows stand together and advance with the same instructions. */
  inline constexpr std::size_t lanes = 8;

  /** Where arrays of n particles end: whole slices, and a lone particle at least. */
  inline std::size_t padded(std::size_t n)
  {
    return (n / lanes + 1) * lanes;
  }

  /**
   * Lone particles fill the arrays up: so far from everything and from each other that no
   * force acts on them, and none of a row's length that is made up with them.
   */
  inline double lone_coordinate(std::size_t number)
  {
    return 1e299 * static_cast<double>(number + 1);
  }

  /**
   * Neighbours of each particle, full rows (a pair stands in both), eight rows side by
   * side and made up to the same length with a lone particle. A row is in the order of
   * the particles' names, so that its sum has the same bits wherever particles lie in
   * memory, whatever the radius and however the neighbours were found.
   */
  class NeighbourRows
  {
  public:
    /** How to look for neighbours. */
    enum class Search
    {
      automatic, ///< by cells, and among all for a few particles
      by_cells,
      among_all
    };

    /**
     * Neighbours nearer than a radius.
     * @param position padded arrays of the coordinates
     * @param names of the particles, 0 to n - 1 in any order, not padded
     */
    void build(int dimension, const std::array<std::vector<double>, 3> &position,
               std::span<const std::uint32_t> names, double radius, Search search,
               const Period &period = {});

    std::size_t slices() const
    {
      return begin.size() - 1;
    }

    /** Neighbours of a particle. */
    std::span<const std::uint32_t> row(std::size_t particle) const
    {
      return found[particle];
    }

    /** First entry of a slice, in entries(). */
    std::size_t offset(std::size_t slice) const
    {
      return begin[slice];
    }

    /** Neighbours, lane by lane. */
    const std::uint32_t *entries() const
    {
      return neighbours.data();
    }

    /** Pairs in the rows, each counted in both. */
    std::size_t pairs() const
    {
      return found.entries.size();
    }

  private:
    void order_by_name(std::span<const std::uint32_t> names);
    void fill_slices();

    std::size_t n = 0;
    FoundRows found;
    std::vector<std::size_t> begin{0};
    std::vector<std::uint32_t> neighbours;
  };
} // namespace meltfront::particles::greenspan

#endif
