#ifndef meltfront_particles_level_set_fast_marching_h
#define meltfront_particles_level_set_fast_marching_h

#include <particles/level_set/band.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace meltfront::particles::level_set
{
  /** What is known of a node, as bits. */
  namespace node_state
  {
    constexpr std::uint8_t known = 1;  ///< its value stands
    constexpr std::uint8_t wanted = 2; ///< to be found
  }                                    // namespace node_state

  /**
   * Distances from known nodes outwards by fast marching (Sethian 1996): |grad phi| = 1
   * with one-sided differences, the nearest node first. First order; so nodes next to the
   * front have to be among the known ones.
   */
  class FastMarching
  {
  public:
    /**
     * Find the values of the region's nodes whose state is `wanted` alone; they become
     * known. A node keeps the sign of its value; only nodes of the same sign count.
     * Those that no known node leads to keep their value.
     *
     * @param values at all nodes (m)
     * @param states of all nodes; ghosts are neither known nor wanted
     */
    void fill(const Grid &grid, std::span<double> values, std::span<std::uint8_t> states,
              const Band &region);

  private:
    using Candidate = std::pair<double, std::size_t>; ///< distance, node

    std::vector<Candidate>
        heap; ///< the nearest first; of nodes in it twice the first counts
  };
} // namespace meltfront::particles::level_set

#endif
