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
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for(std::size_t i = 0; i < points.size(); ++i)
          members[next[cell_of[i]]++] = i;
      }

      /** Visit every point in the cells around a place, each point once. */
      template <typename Visit>
      void visit(const std::array<double, 3> &place, const Visit &visitor) const
      {
        const std::array<int, 3> centre = cell_index(place);
        std::array<int, 3> cell{};
        for(int k = -1; k <= 1; ++k)
          for(int j = -1; j <= 1; ++j)
            for(int i = -1; i <= 1; ++i)
            {
              if(!neighbour_cell(0, centre[0], i, cell[0])
                 || !neighbour_cell(1, centre[1], j, cell[1])
                 || !neighbour_cell(2, centre[2], k, cell[2]))
                continue;
              const std::uint32_t number = cell_number(cell);
              for(std::uint32_t m = first[number]; m < first[number + 1]; ++m)
                visitor(members[m]);
            }
      }

    private:
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

    void collect(const ParticleStorage &particles, const ParticleStorage &others,
                 double radius, const Periodicity &periodicity, bool same,
                 std::vector<std::size_t> &begin, std::vector<std::uint32_t> &entries)
    {
      require_long_periods(particles, radius, periodicity);
      const CellGrid grid(others, radius, periodicity);
      begin.assign(1, 0);
      begin.reserve(particles.size() + 1);
      for(std::size_t a = 0; a < particles.size(); ++a)
      {
        const auto place = particles.point(a);
        grid.visit(place,
                   [&](std::uint32_t b)
                   {
                     if(same && b == a)
                       return;
                     double squared = 0;
                     for(int d = 0; d < particles.dimension; ++d)
                     {
                       const double difference
                           = periodicity.shortest(d, place[d] - others.position[d][b]);
                       squared += difference * difference;
                     }
                     if(squared < radius * radius)
                       entries.push_back(b);
                   });
        std::sort(entries.begin() + begin.back(), entries.end());
        begin.push_back(entries.size());
      }
    }
  } // namespace

  NeighbourList::NeighbourList(const ParticleStorage &particles, double radius,
                               const Periodicity &periodicity)
  {
    collect(particles, particles, radius, periodicity, true, begin, entries);
  }

  NeighbourList::NeighbourList(const ParticleStorage &particles,
                               const ParticleStorage &others, double radius,
                               const Periodicity &periodicity)
  {
    collect(particles, others, radius, periodicity, false, begin, entries);
  }
} // namespace meltfront::particles
