#include <particles/core/neighbour_list.h>
#include <particles/greenspan/neighbour_rows.h>

#include <algorithm>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Up to here looking at all pairs is faster than setting cells up. */
    constexpr std::size_t few_particles = 200;
  } // namespace

  void NeighbourRows::build(int dimension,
                            const std::array<std::vector<double>, 3> &position,
                            std::span<const std::uint32_t> names, double radius,
                            Search search)
  {
    n = names.size();
    if(search == Search::among_all || (search == Search::automatic && n <= few_particles))
      find_among_all(dimension, position, radius);
    else
      find_by_cells(dimension, position, radius);
    order_by_name(names);
    fill_slices();
  }

  void NeighbourRows::find_among_all(int dimension,
                                     const std::array<std::vector<double>, 3> &position,
                                     double radius)
  {
    row_begin.assign(1, 0);
    flat.resize(n * n);
    std::size_t found = 0;
    for(std::size_t a = 0; a < n; ++a)
    {
      for(std::size_t b = 0; b < n; ++b)
      {
        double squared = 0;
        for(int d = 0; d < dimension; ++d)
        {
          const double difference = position[d][a] - position[d][b];
          squared += difference * difference;
        }
        flat[found] = static_cast<std::uint32_t>(b);
        found += (squared < radius * radius) & (a != b);
      }
      row_begin.push_back(found);
    }
    flat.resize(found);
  }

  void NeighbourRows::find_by_cells(int dimension,
                                    const std::array<std::vector<double>, 3> &position,
                                    double radius)
  {
    ParticleStorage storage{dimension, {}};
    for(int d = 0; d < dimension; ++d)
      storage.position[d].assign(position[d].begin(), position[d].begin() + n);
    const NeighbourList list(storage, radius);
    row_begin.assign(1, 0);
    flat.clear();
    flat.reserve(list.size());
    for(std::size_t a = 0; a < n; ++a)
    {
      flat.insert(flat.end(), list[a].begin(), list[a].end());
      row_begin.push_back(flat.size());
    }
  }

  void NeighbourRows::order_by_name(std::span<const std::uint32_t> names)
  {
    if(std::is_sorted(names.begin(), names.end()))
      return;
    for(std::size_t a = 0; a < n; ++a)
      std::sort(flat.begin() + static_cast<std::ptrdiff_t>(row_begin[a]),
                flat.begin() + static_cast<std::ptrdiff_t>(row_begin[a + 1]),
                [names](std::uint32_t p, std::uint32_t q)
                { return names[p] < names[q]; });
  }

  void NeighbourRows::fill_slices()
  {
    const std::size_t count = padded(n) / lanes;
    const auto row = [this](std::size_t a)
    {
      const std::size_t end = a < n ? row_begin[a + 1] : row_begin[n];
      const std::size_t first = a < n ? row_begin[a] : end;
      return std::span<const std::uint32_t>(flat.data() + first, end - first);
    };
    begin.assign(1, 0);
    for(std::size_t slice = 0; slice < count; ++slice)
    {
      std::size_t longest = 0;
      for(std::size_t lane = 0; lane < lanes; ++lane)
        longest = std::max(longest, row(slice * lanes + lane).size());
      begin.push_back(begin.back() + longest * lanes);
    }
    neighbours.assign(begin.back(), static_cast<std::uint32_t>(n));
    for(std::size_t slice = 0; slice < count; ++slice)
      for(std::size_t lane = 0; lane < lanes; ++lane)
      {
        // A lone particle's row is made up with a true one, for itself would be too near.
        const std::size_t a = slice * lanes + lane;
        const auto entries = row(a);
        const std::size_t length = (begin[slice + 1] - begin[slice]) / lanes;
        for(std::size_t e = 0; e < length; ++e)
        {
          std::uint32_t &place = neighbours[begin[slice] + e * lanes + lane];
          if(a >= n)
            place = 0;
          else if(e < entries.size())
            place = entries[e];
        }
      }
  }
} // namespace meltfront::particles::greenspan
