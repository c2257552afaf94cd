#include <particles/greenspan/motion/neighbour_rows.h>

#include <algorithm>

namespace meltfront::particles::greenspan
{
  void NeighbourRows::build(int dimension,
                            const std::array<std::vector<double>, 3> &position,
                            std::span<const std::uint32_t> names, double radius,
                            Search search, const Period &period)
  {
    n = names.size();
    const bool all = search == Search::among_all
                     || (search == Search::automatic && n <= few_particles);
    if(repeats(period))
      found = find_in_periodic_space(dimension, position, n, radius, period, all);
    else
      found = all ? find_among_all(dimension, position, n, radius)
                  : find_in_cells(dimension, position, n, radius);
    order_by_name(names);
    fill_slices();
  }

  /** Particles in the order of their names are appended to the rows of their neighbours:
   * no row needs to be sorted. */
  void NeighbourRows::order_by_name(std::span<const std::uint32_t> names)
  {
    std::vector<std::uint32_t> named(n), filled(n, 0), ordered(found.entries.size());
    for(std::size_t a = 0; a < n; ++a)
      named[names[a]] = static_cast<std::uint32_t>(a);
    for(const std::uint32_t a : named)
      for(const std::uint32_t b : found[a])
        ordered[found.first[b] + filled[b]++] = a;
    found.entries.swap(ordered);
  }

  void NeighbourRows::fill_slices()
  {
    const std::size_t count = padded(n) / lanes;
    const auto length_of
        = [this](std::size_t a) -> std::size_t { return a < n ? found.length[a] : 0; };
    begin.assign(1, 0);
    for(std::size_t slice = 0; slice < count; ++slice)
    {
      std::size_t longest = 0;
      for(std::size_t lane = 0; lane < lanes; ++lane)
        longest = std::max(longest, length_of(slice * lanes + lane));
      begin.push_back(begin.back() + longest * lanes);
    }
    neighbours.assign(begin.back(), static_cast<std::uint32_t>(n));
    for(std::size_t slice = 0; slice < count; ++slice)
      for(std::size_t lane = 0; lane < lanes; ++lane)
      {
        // A lone particle's row is made up with a true one, for itself would be too near.
        const std::size_t a = slice * lanes + lane;
        const std::size_t length = (begin[slice + 1] - begin[slice]) / lanes;
        for(std::size_t e = 0; e < length; ++e)
        {
          std::uint32_t &place = neighbours[begin[slice] + e * lanes + lane];
          if(a >= n)
            place = 0;
          else if(e < found.length[a])
            place = found[a][e];
        }
      }
  }
} // namespace meltfront::particles::greenspan
