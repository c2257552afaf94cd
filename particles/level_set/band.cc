#include <particles/level_set/band.h>

#include <algorithm>
#include <iterator>

namespace meltfront::particles::level_set
{
  namespace
  {
    /** Join what overlaps or touches; the intervals are ascending. */
    void join(std::vector<Interval> &intervals)
    {
      std::size_t kept = 0;
      for(std::size_t n = 1; n < intervals.size(); ++n)
      {
        Interval &last = intervals[kept];
        const Interval &next = intervals[n];
        if(next.k == last.k && next.j == last.j && next.begin <= last.end)
          last.end = std::max(last.end, next.end);
        else
          intervals[++kept] = next;
      }
      if(!intervals.empty())
        intervals.resize(kept + 1);
    }

    void widen_rows(std::vector<Interval> &intervals, const int layers, const int nodes)
    {
      for(Interval &interval : intervals)
      {
        interval.begin = std::max(interval.begin - layers, 0);
        interval.end = std::min(interval.end + layers, nodes);
      }
      join(intervals);
    }

    /** Move the set down by `layers` rows, then join it with itself moved up by 1, 2, 4,
     * ... rows until it covers 2 layers + 1. */
    void add_rows(std::vector<Interval> &intervals, int Interval::*row, const int layers,
                  const int nodes)
    {
      for(Interval &interval : intervals)
        interval.*row -= layers;
      std::vector<Interval> moved, joined;
      for(int covered = 1; covered < 2 * layers + 1;)
      {
        const int shift = std::min(covered, 2 * layers + 1 - covered);
        moved = intervals;
        for(Interval &interval : moved)
          interval.*row += shift;
        joined.clear();
        std::ranges::merge(intervals, moved, std::back_inserter(joined));
        join(joined);
        intervals.swap(joined);
        covered += shift;
      }
      std::erase_if(intervals, [&](const Interval &interval)
                    { return interval.*row < 0 || interval.*row >= nodes; });
    }
  } // namespace

  Band::Band(const Grid &grid, std::vector<Interval> intervals)
    : all_intervals(std::move(intervals))
  {
    all_runs.reserve(all_intervals.size());
    for(const Interval &interval : all_intervals)
    {
      const std::array<int, 3> index{interval.begin, interval.j, interval.k};
      all_runs.push_back({grid.node(index), count, interval.end - interval.begin, index});
      count += static_cast<std::size_t>(interval.end - interval.begin);
    }
  }

  std::vector<Interval> dilated(const Grid &grid, std::vector<Interval> intervals,
                                const int layers)
  {
    join(intervals);
    if(layers == 0)
      return intervals;
    widen_rows(intervals, layers, grid.nodes(0));
    add_rows(intervals, &Interval::j, layers, grid.nodes(1));
    if(grid.dimension() == 3)
      add_rows(intervals, &Interval::k, layers, grid.nodes(2));
    return intervals;
  }

  std::vector<Interval> whole_grid(const Grid &grid)
  {
    std::vector<Interval> rows;
    for(int k = 0; k < grid.nodes(2); ++k)
      for(int j = 0; j < grid.nodes(1); ++j)
        rows.push_back({k, j, 0, grid.nodes(0)});
    return rows;
  }
} // namespace meltfront::particles::level_set
