#include <particles/scattered/compressed_rows.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::particles
{
  void CompressedRows::add_row(std::span<const std::uint32_t> row_columns,
                               std::span<const double> row_coefficients,
                               std::vector<std::uint32_t> &scratch)
  {
    scratch.resize(row_columns.size());
    std::iota(scratch.begin(), scratch.end(), 0U);
    std::ranges::stable_sort(scratch, {},
                             [&](std::uint32_t e) { return row_columns[e]; });
    for(const std::uint32_t e : scratch)
      if(columns.size() > offsets.back() && columns.back() == row_columns[e])
        coefficients.back() += row_coefficients[e];
      else
      {
        columns.push_back(row_columns[e]);
        coefficients.push_back(row_coefficients[e]);
      }
    offsets.push_back(columns.size());
  }

  void CompressedRows::multiply(std::span<const double> vector, std::span<double> result,
                                int threads) const
  {
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
    for(std::size_t i = 0; i < rows(); ++i)
    {
      double sum = 0;
      for(std::size_t e = offsets[i]; e < offsets[i + 1]; ++e)
        sum += coefficients[e] * vector[columns[e]];
      result[i] = sum;
    }
  }

  std::vector<double> CompressedRows::diagonal() const
  {
    std::vector<double> result(rows());
    for(std::size_t i = 0; i < rows(); ++i)
      for(std::size_t e = offsets[i]; e < offsets[i + 1]; ++e)
        if(columns[e] == i)
          result[i] = coefficients[e];
    return result;
  }

  double CompressedRows::asymmetry() const
  {
    double largest = 0, difference = 0;
    for(std::size_t i = 0; i < rows(); ++i)
      for(std::size_t e = offsets[i]; e < offsets[i + 1]; ++e)
      {
        const std::size_t j = columns[e];
        const auto begin = columns.begin() + static_cast<long>(offsets[j]);
        const auto end = columns.begin() + static_cast<long>(offsets[j + 1]);
        const auto found = std::lower_bound(begin, end, i);
        const double mirrored
            = found != end && *found == i ? coefficients[found - columns.begin()] : 0;
        largest = std::max(largest, std::abs(coefficients[e]));
        difference = std::max(difference, std::abs(coefficients[e] - mirrored));
      }
    return largest > 0 ? difference / largest : 0;
  }

  std::size_t CompressedRows::bytes() const
  {
    return sizeof(std::size_t) * offsets.size() + sizeof(std::uint32_t) * columns.size()
           + sizeof(double) * coefficients.size();
  }

  CompressedRows sum_of(double first_factor, const CompressedRows &first,
                        double second_factor, const CompressedRows &second)
  {
    CompressedRows result;
    result.columns.reserve(first.size());
    result.coefficients.reserve(first.size());
    for(std::size_t i = 0; i < first.rows(); ++i)
    {
      std::size_t a = first.offsets[i], b = second.offsets[i];
      const std::size_t a_end = first.offsets[i + 1], b_end = second.offsets[i + 1];
      while(a < a_end || b < b_end)
      {
        const bool of_first
            = a < a_end && (b == b_end || first.columns[a] <= second.columns[b]);
        const bool of_second
            = b < b_end && (a == a_end || second.columns[b] <= first.columns[a]);
        result.columns.push_back(of_first ? first.columns[a] : second.columns[b]);
        double value = 0;
        if(of_first)
          value += first_factor * first.coefficients[a++];
        if(of_second)
          value += second_factor * second.coefficients[b++];
        result.coefficients.push_back(value);
      }
      result.offsets.push_back(result.columns.size());
    }
    return result;
  }
} // namespace meltfront::particles
