#ifndef meltfront_particles_level_set_band_h
#define meltfront_particles_level_set_band_h

#include <cases/velocity_field.h>
#include <particles/level_set/grid.h>

#include <compare>
#include <span>
#include <vector>

namespace meltfront::particles::level_set
{
  /** Nodes next to each other along x: begin <= i < end. */
  struct Interval
  {
    int k = 0, j = 0, begin = 0, end = 0;

    auto operator<=>(const Interval &) const = default;
  };

  /** An interval of a band with the numbers of its nodes. */
  struct NodeRun
  {
    std::size_t node = 0;     ///< number of its first node in the grid
    std::size_t first = 0;    ///< number of its first node in the band
    int length = 0;           ///< nodes
    std::array<int, 3> index; ///< indices of its first node
  };

  /**
   * A set of nodes, those next to each other along x in one run: inner loops run through
   * memory in order. Arrays "along the band" hold one value per node, run by run.
   */
  class Band
  {
  public:
    Band() = default;

    /** @param intervals ascending, apart from each other, within the grid */
    Band(const Grid &grid, std::vector<Interval> intervals);

    std::span<const NodeRun> runs() const
    {
      return all_runs;
    }

    std::span<const Interval> intervals() const
    {
      return all_intervals;
    }

    /** Nodes. */
    std::size_t size() const
    {
      return count;
    }

  private:
    std::vector<Interval> all_intervals;
    std::vector<NodeRun> all_runs;
    std::size_t count = 0;
  };

  /**
   * All nodes of the grid no further than `layers` from the given ones along each
   * coordinate. The work grows with the number of intervals, not with the grid.
   *
   * @param intervals ascending; they may overlap
   */
  std::vector<Interval> dilated(const Grid &grid, std::vector<Interval> intervals,
                                int layers);

  /** Every node of the grid, row by row. */
  std::vector<Interval> whole_grid(const Grid &grid);
} // namespace meltfront::particles::level_set

#endif
