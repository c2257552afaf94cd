#include <cases/error.h>
#include <particles/core/neighbour_list.h>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace meltfront::particles
{
  namespace
  {
    /** Points sorted into cells that are at least a radius wide. */
    class CellGrid
    {
    public:
      CellGrid(const ParticleStorage &points, double radius,
               const Periodicity &periodicity)
        : dimension(points.dimension)
        , periodicity(periodicity)
      {
        for(int d = 0; d < dimension; ++d)
          set_up_direction(points, d, radius);
        const std::size_t cells = std::size_t(count[0]) * count[1] * count[2];
        std::vector<std::uint32_t> cell_of(points.size());
        first.assign(cells + 1, 0);
        for(std::size_t i = 0; i < points.size(); ++i)
        {
          cell_of[i] = cell_number(cell_index(points.point(i)));
          ++first[cell_of[i] + 1];
        }
        std::partial_sum(first.begin(), first.end(), first.begin());
        members.resize(points.size());
        for(int d = 0; d < dimension; ++d)
          coordinate[d].resize(points.size());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for(std::size_t i = 0; i < points.size(); ++i)
        {
          const std::uint32_t place = next[cell_of[i]]++;
          members[place] = i;
          for(int d = 0; d < dimension; ++d)
            coordinate[d][place] = points.position[d][i];
        }
      }

      /**
       * Append the points nearer to a place than a radius, in any order. The loop has no
       * branch: each point is written, and counted only if it is near.
       * @param entries has room for all points of the cells around the place
       */
      template <int Dimension>
      std::size_t find(const std::array<double, 3> &place, double radius,
                       std::uint32_t *entries) const
      {
        const double squared_radius = radius * radius;
        std::size_t found = 0;
        visit_ranges(place,
                     [&](std::uint32_t begin, std::uint32_t end)
                     {
                       for(std::uint32_t m = begin; m < end; ++m)
                       {
                         double squared = 0;
                         for(int d = 0; d < Dimension; ++d)
                         {
                           const double difference
                               = periodicity.shortest(d, place[d] - coordinate[d][m]);
                           squared += difference * difference;
                         }
                         entries[found] = members[m];
                         found += squared < squared_radius;
                       }
                     });
        return found;
      }

      /** Number of points in the cells around a place. */
      std::size_t candidates(const std::array<double, 3> &place) const
      {
        std::size_t sum = 0;
        visit_ranges(place, [&sum](std::uint32_t begin, std::uint32_t end)
                     { sum += end - begin; });
        return sum;
      }

    private:
      /** Visit the ranges of points in the cells around a place: cells that are next to
       * each other along x are so in memory. */
      template <typename Visit>
      void visit_ranges(const std::array<double, 3> &place, const Visit &visitor) const
      {
        const std::array<int, 3> centre = cell_index(place);
        std::array<int, 3> cell{};
        const bool wraps = periodicity.period[0] > 0 && count[0] > 1;
        for(int k = -1; k <= 1; ++k)
          for(int j = -1; j <= 1; ++j)
          {
            if(!neighbour_cell(1, centre[1], j, cell[1])
               || !neighbour_cell(2, centre[2], k, cell[2]))
              continue;
            cell[0] = 0;
            const std::uint32_t line = cell_number(cell);
            const int low = centre[0] - 1, high = centre[0] + 1;
            visitor(first[line + std::max(low, 0)],
                    first[line + std::min(high, count[0] - 1) + 1]);
            if(wraps && low < 0)
              visitor(first[line + count[0] - 1], first[line + count[0]]);
            if(wraps && high == count[0])
              visitor(first[line], first[line + 1]);
          }
      }

      void set_up_direction(const ParticleStorage &points, int d, double radius)
      {
        const auto &x = points.position[d];
        if(x.empty())
          return;
        const double period = periodicity.period[d];
        lowest[d] = *std::min_element(x.begin(), x.end());
        const double extent
            = period > 0 ? period : *std::max_element(x.begin(), x.end()) - lowest[d];
        // More cells than points along a side would only cost memory.
        const double most
            = std::ceil(std::pow(double(points.size()), 1. / dimension)) + 2;
        count[d]
            = std::max(1, static_cast<int>(std::min(most, std::floor(extent / radius))));
        if(period > 0 && count[d] < 3)
          count[d] = 1;
        width[d] = extent > 0 ? extent / count[d] : 1;
      }

      std::array<int, 3> cell_index(const std::array<double, 3> &place) const
      {
        std::array<int, 3> index{};
        for(int d = 0; d < dimension; ++d)
        {
          const int i = static_cast<int>(std::floor((place[d] - lowest[d]) / width[d]));
          index[d] = periodicity.period[d] > 0 ? ((i % count[d]) + count[d]) % count[d]
                                               : std::clamp(i, 0, count[d] - 1);
        }
        return index;
      }

      std::uint32_t cell_number(const std::array<int, 3> &index) const
      {
        return (std::uint32_t(index[2]) * count[1] + index[1]) * count[0] + index[0];
      }

      bool neighbour_cell(int d, int centre, int step, int &cell) const
      {
        cell = centre + step;
        if(periodicity.period[d] > 0 && count[d] > 1)
          cell = (cell + count[d]) % count[d];
        return cell >= 0 && cell < count[d];
      }

      int dimension;
      Periodicity periodicity;
      std::array<int, 3> count{1, 1, 1};
      std::array<double, 3> lowest{};
      std::array<double, 3> width{1, 1, 1};
      std::vector<std::uint32_t> first;
      std::vector<std::uint32_t> members;
      std::array<std::vector<double>, 3> coordinate; ///< of the members
    };

    void require_long_periods(const ParticleStorage &particles, double radius,
                              const Periodicity &periodicity)
    {
      for(int d = 0; d < particles.dimension; ++d)
        if(periodicity.period[d] > 0 && periodicity.period[d] < 2 * radius * (1 - 1e-12))
          throw cases::InputError(fmt::format(
              "the period {:.6g} m in direction {} is shorter than two radii of "
              "interaction of {:.6g} m",
              periodicity.period[d], d, radius));
    }

    /** Rows of the points near each particle, in any order, itself among them if it is
     * one of the points. */
    template <int Dimension>
    void collect(const ParticleStorage &particles, const CellGrid &grid, double radius,
                 std::vector<std::size_t> &begin, std::vector<std::uint32_t> &entries)
    {
      begin.assign(1, 0);
      begin.reserve(particles.size() + 1);
      entries.clear();
      for(std::size_t a = 0; a < particles.size(); ++a)
      {
        const auto place = particles.point(a);
        const std::size_t needed = begin.back() + grid.candidates(place);
        if(needed > entries.size())
          entries.resize(std::max(needed, 2 * entries.size()));
        begin.push_back(
            begin.back()
            + grid.find<Dimension>(place, radius, entries.data() + begin.back()));
      }
      entries.resize(begin.back());
    }

    void collect(const ParticleStorage &particles, const ParticleStorage &others,
                 double radius, const Periodicity &periodicity,
                 std::vector<std::size_t> &begin, std::vector<std::uint32_t> &entries)
    {
      require_long_periods(particles, radius, periodicity);
      const CellGrid grid(others, radius, periodicity);
      switch(particles.dimension)
      {
      case 1:
        return collect<1>(particles, grid, radius, begin, entries);
      case 2:
        return collect<2>(particles, grid, radius, begin, entries);
      default:
        return collect<3>(particles, grid, radius, begin, entries);
      }
    }

    /**
     * Order the rows of a symmetric list, and leave out each particle itself: particles
     * in ascending order are appended to the rows of their neighbours.
     */
    void order_symmetric(std::vector<std::size_t> &begin,
                         std::vector<std::uint32_t> &entries)
    {
      const std::size_t n = begin.size() - 1;
      std::vector<std::uint32_t> ordered(entries.size() - n);
      std::vector<std::size_t> next(n);
      for(std::size_t a = 0; a < n; ++a)
        next[a] = begin[a] - a;
      for(std::size_t a = 0; a < n; ++a)
        for(std::size_t e = begin[a]; e < begin[a + 1]; ++e)
          if(entries[e] != a)
            ordered[next[entries[e]]++] = a;
      for(std::size_t a = 0; a <= n; ++a)
        begin[a] -= a;
      entries.swap(ordered);
    }
  } // namespace

  NeighbourList::NeighbourList(const ParticleStorage &particles, double radius,
                               const Periodicity &periodicity)
  {
    collect(particles, particles, radius, periodicity, begin, entries);
    order_symmetric(begin, entries);
  }

  NeighbourList::NeighbourList(const ParticleStorage &particles,
                               const ParticleStorage &others, double radius,
                               const Periodicity &periodicity)
  {
    collect(particles, others, radius, periodicity, begin, entries);
    for(std::size_t a = 0; a < rows(); ++a)
      std::sort(entries.begin() + static_cast<std::ptrdiff_t>(begin[a]),
                entries.begin() + static_cast<std::ptrdiff_t>(begin[a + 1]));
  }

  NeighbourList NeighbourList::kept(const std::vector<bool> &marked) const
  {
    NeighbourList result;
    result.begin.push_back(0);
    for(std::size_t row = 0; row < rows(); ++row)
    {
      for(std::size_t e = begin[row]; e < begin[row + 1]; ++e)
        if(marked[e])
          result.entries.push_back(entries[e]);
      result.begin.push_back(result.entries.size());
    }
    return result;
  }
} // namespace meltfront::particles
