#ifndef meltfront_particles_core_neighbour_list_h
#define meltfront_particles_core_neighbour_list_h

#include <particles/core/particle_storage.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** Directions in which space repeats itself: the period in each, 0 where it does not.
   */
  struct Periodicity
  {
    std::array<double, 3> period{};

    /** The difference of two coordinates, taken between the nearest images. */
    double shortest(int direction, double difference) const
    {
      const double length = period[direction];
      return length > 0 ? difference - length * std::nearbyint(difference / length)
                        : difference;
    }
  };

  /**
   * For each point the particles nearer than a radius: full lists (a pair stands in both
   * rows) in one flat array, ascending in each row.
   */
  class NeighbourList
  {
  public:
    /**
     * Neighbours of each particle among all others, not itself.
     * @throws cases::InputError if a period is shorter than two radii, for then a pair
     * would meet more than once.
     */
    NeighbourList(const ParticleStorage &particles, double radius,
                  const Periodicity &periodicity = {});

    /** For each particle, neighbours among another set of points. */
    NeighbourList(const ParticleStorage &particles, const ParticleStorage &others,
                  double radius, const Periodicity &periodicity = {});

    /** The same rows with those entries alone, by their places in the flat array, that
     * are marked. */
    NeighbourList kept(const std::vector<bool> &marked) const;

    std::size_t rows() const
    {
      return begin.size() - 1;
    }

    /** Number of entries over all rows. */
    std::size_t size() const
    {
      return entries.size();
    }

    /** Position of a row's first entry in the flat array; offset(rows()) is its end. */
    std::size_t offset(std::size_t row) const
    {
      return begin[row];
    }

    std::span<const std::uint32_t> operator[](std::size_t row) const
    {
      return {entries.data() + begin[row], begin[row + 1] - begin[row]};
    }

  private:
    NeighbourList() = default;

    std::vector<std::size_t> begin;
    std::vector<std::uint32_t> entries;
  };
} // namespace meltfront::particles

#endif
