#include <particles/core/particle_operator.h>

#include <algorithm>

namespace meltfront::particles
{
  ParticleOperator::ParticleOperator(const NeighbourList &neighbours,
                                     std::span<const double> coefficients)
    : n_rows(neighbours.rows())
    , n_interactions(neighbours.size())
  {
    const std::size_t n_slices = (n_rows + lanes - 1) / lanes;
    slice_begin.assign(1, 0);
    for(std::size_t slice = 0; slice < n_slices; ++slice)
    {
      std::size_t widest = 0, entries = 0;
      for(std::size_t a = slice * lanes; a < std::min(n_rows, (slice + 1) * lanes); ++a)
      {
        widest = std::max(widest, neighbours[a].size());
        entries += neighbours[a].size();
      }
      slice_begin.push_back(slice_begin.back() + widest * lanes);
      slice_interactions.push_back(entries);
    }
    neighbours_of.resize(slice_begin.back());
    for(std::size_t slice = 0; slice < n_slices; ++slice)
      for(std::size_t lane = 0; lane < lanes; ++lane)
      {
        const std::size_t a = slice * lanes + lane;
        std::size_t e = slice_begin[slice] + lane;
        if(a < n_rows)
          for(const std::uint32_t b : neighbours[a])
          {
            neighbours_of[e] = b;
            e += lanes;
          }
        for(; e < slice_begin[slice + 1]; e += lanes)
          neighbours_of[e] = a;
      }
    refresh(neighbours, coefficients);
  }

  void ParticleOperator::refresh(const NeighbourList &neighbours,
                                 std::span<const double> coefficients)
  {
    coefficient.assign(slice_begin.back(), 0.);
    for(std::size_t a = 0; a < n_rows; ++a)
    {
      std::size_t e = slice_begin[a / lanes] + a % lanes;
      for(std::size_t i = neighbours.offset(a); i < neighbours.offset(a + 1); ++i)
      {
        coefficient[e] = coefficients[i];
        e += lanes;
      }
    }
  }

  std::size_t ParticleOperator::bytes() const
  {
    return slice_begin.size() * sizeof(slice_begin[0])
           + slice_interactions.size() * sizeof(slice_interactions[0])
           + neighbours_of.size() * sizeof(neighbours_of[0])
           + coefficient.size() * sizeof(coefficient[0]);
  }

  void ParticleOperator::apply(std::span<const double> value, std::span<double> result,
                               int threads) const
  {
    const double *v = value.data();
    const auto difference = [v](std::size_t a, std::size_t b) { return v[b] - v[a]; };
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
    for(std::size_t slice = 0; slice < slices(); ++slice)
      apply_to_slice(slice, difference, result.data());
  }

  std::vector<ParticleOperator::Entry>
  ParticleOperator::differing_pairs(const ParticleOperator &other) const
  {
    std::vector<Entry> result;
    for(std::size_t row = 0; row < n_rows; ++row)
    {
      const std::size_t slice = row / lanes;
      for(std::size_t e = slice_begin[slice] + row % lanes; e < slice_begin[slice + 1];
          e += lanes)
        if(neighbours_of[e] > row && coefficient[e] != other.coefficient[e])
          result.push_back({static_cast<std::uint32_t>(row), neighbours_of[e],
                            other.coefficient[e] - coefficient[e]});
    }
    return result;
  }

  void ParticleOperator::slice_adjacency(std::vector<std::size_t> &offsets,
                                         std::vector<std::uint32_t> &adjacent) const
  {
    offsets.assign(1, 0);
    adjacent.clear();
    std::vector<std::uint32_t> found;
    for(std::size_t slice = 0; slice < slices(); ++slice)
    {
      found.assign(1, slice);
      for(std::size_t e = slice_begin[slice]; e < slice_begin[slice + 1]; ++e)
        found.push_back(neighbours_of[e] / lanes);
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      adjacent.insert(adjacent.end(), found.begin(), found.end());
      offsets.push_back(adjacent.size());
    }
  }
} // namespace meltfront::particles
