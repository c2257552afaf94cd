#include <cases/error.h>
#include <particles/core/particle_operator.h>
#include <particles/sph/ranks/rank_particles.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    constexpr std::size_t lanes = ParticleOperator::lanes;

    /** Marks on the cells of the lattice that particles fill. */
    class LatticeMarks
    {
    public:
      explicit LatticeMarks(const Discretisation &dis)
        : dimension(dis.dimension)
        , cell_of(dis.particles.size(), 0)
      {
        std::size_t stride = 1;
        for(int d = 0; d < dimension; ++d)
        {
          const auto &x = dis.particles.position[d];
          const auto [lowest, highest] = std::ranges::minmax(x);
          const auto cells = [&, low = lowest](double place)
          { return static_cast<std::size_t>(std::lround((place - low) / dis.cell[d])); };
          count[d] = cells(highest) + 1;
          wraps[d] = dis.periodicity.period[d] > 0;
          for(std::size_t i = 0; i < x.size(); ++i)
            cell_of[i] += static_cast<std::uint32_t>(cells(x[i]) * stride);
          stride *= count[d];
        }
        marked.assign(stride, 0);
      }

      bool holds(std::size_t particle) const
      {
        return marked[cell_of[particle]] != 0;
      }

      void mark(std::size_t begin, std::size_t end)
      {
        for(std::size_t i = begin; i < end; ++i)
          marked[cell_of[i]] = 1;
      }

      /** Mark so many cells more in every direction, across corners too. */
      void widen(int cells)
      {
        for(; cells > 0; --cells)
        {
          std::size_t stride = 1;
          for(int d = 0; d < dimension; ++d)
          {
            widen_along(stride, count[d], wraps[d]);
            stride *= count[d];
          }
        }
      }

      /** Mark all particles of the slices in which one is marked. */
      void fill_slices()
      {
        const std::size_t n = cell_of.size();
        for(std::size_t begin = 0; begin < n; begin += lanes)
        {
          const std::size_t end = std::min(begin + lanes, n);
          for(std::size_t i = begin; i < end; ++i)
            if(holds(i))
            {
              mark(begin, end);
              break;
            }
        }
      }

      void add(const LatticeMarks &other)
      {
        for(std::size_t c = 0; c < marked.size(); ++c)
          marked[c] |= other.marked[c];
      }

    private:
      void widen_along(std::size_t stride, std::size_t cells, bool periodic)
      {
        const std::vector<char> before = marked;
        for(std::size_t c = 0; c < before.size(); ++c)
        {
          if(before[c] == 0)
            continue;
          const std::size_t along = c / stride % cells;
          if(along > 0)
            marked[c - stride] = 1;
          else if(periodic)
            marked[c + (cells - 1) * stride] = 1;
          if(along + 1 < cells)
            marked[c + stride] = 1;
          else if(periodic)
            marked[c - (cells - 1) * stride] = 1;
        }
      }

      int dimension;
      std::array<std::size_t, 3> count{1, 1, 1};
      std::array<bool, 3> wraps{};
      std::vector<std::uint32_t> cell_of; ///< of each particle
      std::vector<char> marked;
    };
  } // namespace

  RankParticles particles_of_rank(const Discretisation &whole, const HaloDepth &depth,
                                  int rank, int ranks)
  {
    const std::size_t n = whole.particles.size(), slices = (n + lanes - 1) / lanes;
    if(slices < static_cast<std::size_t>(ranks))
      throw cases::Refusal(fmt::format("sph gives each rank {} particles at least, and "
                                       "there are {} for {} ranks: take "
                                       "a larger n or fewer ranks",
                                       lanes, n, ranks));
    const auto first_of = [&](int r)
    { return std::min(n, slices * static_cast<std::size_t>(r) / ranks * lanes); };
    const std::size_t first = first_of(rank), last = first_of(rank + 1);
    LatticeMarks held(whole);
    held.mark(first, last);
    LatticeMarks near_fronts = held;
    held.widen(depth.values);
    if(depth.fronts > 0)
    {
      near_fronts.widen(depth.fronts);
      near_fronts.fill_slices();
      near_fronts.widen(1);
      held.add(near_fronts);
    }
    held.fill_slices();
    RankParticles result;
    for(std::size_t i = 0; i < n; ++i)
      if(held.holds(i))
      {
        if(i == first)
          result.own.begin = result.numbers.size();
        result.numbers.push_back(static_cast<std::uint32_t>(i));
      }
    result.own.end = result.own.begin + (last - first);
    result.own.first_number = first;
    result.own.all = n;
    return result;
  }
} // namespace meltfront::particles
