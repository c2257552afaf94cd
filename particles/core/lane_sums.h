#ifndef meltfront_particles_core_lane_sums_h
#define meltfront_particles_core_lane_sums_h

#include <cstddef>
#include <cstring>

namespace meltfront::particles
{
  /**
   * Sums of the rows of a slice, one per lane. Vectors of the compiler stay in registers,
   * where an array would be written and read again for each entry.
   */
  template <std::size_t lanes>
  class LaneSums
  {
  public:
    void add(const double *terms)
    {
      Half low, high;
      std::memcpy(&low, terms, sizeof(low));
      std::memcpy(&high, terms + lanes / 2, sizeof(high));
      first += low;
      second += high;
    }

    void store(double *result) const
    {
      std::memcpy(result, &first, sizeof(first));
      std::memcpy(result + lanes / 2, &second, sizeof(second));
    }

  private:
    using Half [[gnu::vector_size(lanes / 2 * sizeof(double))]] = double;
    Half first{}, second{};
  };
} // namespace meltfront::particles

#endif
