#include <reference_fem/enthalpy/nested_level.h>

#include <algorithm>
#include <limits>

namespace meltfront::reference_fem
{
  SparseRows SparseRows::transposed(std::size_t columns) const
  {
    SparseRows result;
    result.start.assign(columns + 1, 0);
    for(const unsigned int j : column)
      ++result.start[j + 1];
    for(std::size_t j = 0; j < columns; ++j)
      result.start[j + 1] += result.start[j];
    result.column.resize(column.size());
    result.value.resize(value.size());
    std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
    for(std::size_t i = 0; i < size(); ++i)
      for(std::size_t k = start[i]; k < start[i + 1]; ++k)
      {
        const std::size_t place = next[column[k]]++;
        result.column[place] = static_cast<unsigned int>(i);
        result.value[place] = value[k];
      }
    return result;
  }

  NestedLevel::NestedLevel(const ConductionMatrix &network, int dimension)
    : dimension(dimension)
    , couplings{network.row_start, network.column, {}}
  {
  }

  /** Two nodes of a coarse level are coupled where nodes that are coupled, or one node,
   * interpolate between them. */
  NestedLevel NestedLevel::coarser() const
  {
    NestedLevel result(dimension);
    constexpr unsigned int none = std::numeric_limits<unsigned int>::max();
    std::vector<unsigned int> seen_by(coarse_size(), none);
    std::vector<unsigned int> row;
    for(unsigned int p = 0; p < coarse_size(); ++p)
    {
      row.clear();
      seen_by[p] = p;
      const auto meet = [&](std::size_t j)
      {
        for(std::size_t k = shares.start[j]; k < shares.start[j + 1]; ++k)
          if(const unsigned int q = shares.column[k]; seen_by[q] != p)
          {
            seen_by[q] = p;
            row.push_back(q);
          }
      };
      for(std::size_t k = gathered.start[p]; k < gathered.start[p + 1]; ++k)
      {
        const std::size_t i = gathered.column[k];
        meet(i);
        for(std::size_t m = couplings.start[i]; m < couplings.start[i + 1]; ++m)
          meet(couplings.column[m]);
      }
      std::ranges::sort(row);
      result.couplings.column.insert(result.couplings.column.end(), row.begin(),
                                     row.end());
      result.couplings.start.push_back(result.couplings.column.size());
    }
    return result;
  }

  void NestedLevel::interpolate_from(SparseRows from, std::size_t nodes_of_coarser)
  {
    shares = std::move(from);
    gathered = shares.transposed(nodes_of_coarser);
  }

  void NestedLevel::add_interpolated(const std::vector<double> &on_coarse,
                                     const char *mask, std::vector<double> &fine) const
  {
    for(std::size_t i = 0; i < size(); ++i)
      if(!mask || mask[i])
      {
        double sum = 0;
        for(std::size_t k = shares.start[i]; k < shares.start[i + 1]; ++k)
          sum += shares.value[k] * on_coarse[shares.column[k]];
        fine[i] += sum;
      }
  }

  void NestedLevel::restrict_to(const std::vector<double> &fine, const char *mask,
                                std::vector<double> &on_coarse) const
  {
    on_coarse.resize(coarse_size());
    for(std::size_t p = 0; p < on_coarse.size(); ++p)
    {
      double sum = 0;
      for(std::size_t k = gathered.start[p]; k < gathered.start[p + 1]; ++k)
        if(const std::size_t i = gathered.column[k]; !mask || mask[i])
          sum += gathered.value[k] * fine[i];
      on_coarse[p] = sum;
    }
  }

  NestedMatrix::NestedMatrix(const NestedLevel &level, const ConductionMatrix &network)
    : diagonal(network.diagonal)
    , level(level)
    , conductance(network.conductance.data())
  {
  }

  NestedMatrix::NestedMatrix(const NestedLevel &level)
    : diagonal(level.size())
    , level(level)
    , own(level.couplings.column.size())
    , conductance(own.data())
  {
  }

  void NestedMatrix::restrict_from(const NestedMatrix &finer,
                                   const std::vector<double> &finer_diagonal,
                                   const char *mask)
  {
    const NestedLevel &fine = finer.level;
    // Where the entries of a row are kept, by column.
    std::vector<double *> place(level.size());
    for(std::size_t p = 0; p < level.size(); ++p)
    {
      double on_diagonal = 0;
      place[p] = &on_diagonal;
      for(std::size_t k = level.couplings.start[p]; k < level.couplings.start[p + 1]; ++k)
      {
        own[k] = 0;
        place[level.couplings.column[k]] = &own[k];
      }
      // With the sign of conductances.
      const auto add = [&](std::size_t j, double entry)
      {
        for(std::size_t k = fine.shares.start[j]; k < fine.shares.start[j + 1]; ++k)
          *place[fine.shares.column[k]] += entry * fine.shares.value[k];
      };
      for(std::size_t k = fine.gathered.start[p]; k < fine.gathered.start[p + 1]; ++k)
      {
        const std::size_t i = fine.gathered.column[k];
        if(mask && !mask[i])
          continue;
        const double share = fine.gathered.value[k];
        add(i, -share * finer_diagonal[i]);
        for(std::size_t m = fine.couplings.start[i]; m < fine.couplings.start[i + 1]; ++m)
          if(const std::size_t j = fine.couplings.column[m]; !mask || mask[j])
            add(j, share * finer.conductance[m]);
      }
      diagonal[p] = -on_diagonal;
    }
  }

  void NestedMatrix::subtract_product(const std::vector<double> &diagonal_of,
                                      const std::vector<double> &x,
                                      std::vector<double> &y) const
  {
    for(std::size_t i = 0; i < level.size(); ++i)
      y[i] -= diagonal_of[i] * x[i] - from_others(i, x);
  }

  void NestedMatrix::restrict_residual(const std::vector<double> &diagonal_of,
                                       const char *mask,
                                       const std::vector<double> &right_side,
                                       const std::vector<double> &x,
                                       std::vector<double> &on_coarse) const
  {
    std::fill(on_coarse.begin(), on_coarse.end(), 0);
    for(std::size_t i = 0; i < level.size(); ++i)
    {
      if(mask && !mask[i])
        continue;
      const double left = right_side[i] - diagonal_of[i] * x[i] + from_others(i, x);
      for(std::size_t k = level.shares.start[i]; k < level.shares.start[i + 1]; ++k)
        on_coarse[level.shares.column[k]] += level.shares.value[k] * left;
    }
  }
} // namespace meltfront::reference_fem
