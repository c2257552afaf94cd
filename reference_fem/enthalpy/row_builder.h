#ifndef meltfront_reference_fem_enthalpy_row_builder_h
#define meltfront_reference_fem_enthalpy_row_builder_h

#include <reference_fem/enthalpy/conduction_matrix.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace meltfront::reference_fem
{
  /** The rows of a network under construction, each with room for some neighbours. */
  class RowBuilder
  {
  public:
    explicit RowBuilder(const std::vector<unsigned int> &room)
      : first(room.size() + 1, 0)
      , filled(room.size(), 0)
    {
      std::partial_sum(room.begin(), room.end(), first.begin() + 1,
                       std::plus<std::size_t>());
      column.resize(first.back());
      conductance.resize(first.back());
    }

    void add(unsigned int i, unsigned int j, double value)
    {
      const std::size_t end = first[i] + filled[i];
      std::size_t k = first[i];
      while(k < end && column[k] != j)
        ++k;
      if(k == end)
      {
        column[k] = j;
        conductance[k] = 0;
        ++filled[i];
      }
      conductance[k] += value;
    }

    /** Sorts and closes up the rows; nothing is left here. */
    void move_to(ConductionMatrix &matrix)
    {
      std::size_t end = 0;
      std::vector<std::pair<unsigned int, double>> row;
      for(std::size_t i = 0; i < filled.size(); ++i)
      {
        row.clear();
        for(std::size_t k = first[i]; k < first[i] + filled[i]; ++k)
          row.emplace_back(column[k], conductance[k]);
        std::sort(row.begin(), row.end());
        for(const auto &[j, value] : row)
        {
          column[end] = j;
          conductance[end] = value;
          matrix.diagonal[i] += value;
          ++end;
        }
        matrix.row_start.push_back(end);
      }
      column.resize(end);
      conductance.resize(end);
      matrix.column = std::move(column);
      matrix.conductance = std::move(conductance);
    }

  private:
    std::vector<std::size_t> first;
    std::vector<unsigned int> filled, column;
    std::vector<double> conductance;
  };
} // namespace meltfront::reference_fem

#endif
