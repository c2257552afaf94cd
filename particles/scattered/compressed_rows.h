#ifndef meltfront_particles_scattered_compressed_rows_h
#define meltfront_particles_scattered_compressed_rows_h

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** A sparse matrix by rows: entry e of row i, offsets[i] <= e < offsets[i + 1], stands
   * in columns[e] with coefficients[e]. Columns of a row ascend and none comes twice. */
  struct CompressedRows
  {
    std::vector<std::size_t> offsets{0};
    std::vector<std::uint32_t> columns;
    std::vector<double> coefficients;

    std::size_t rows() const
    {
      return offsets.size() - 1;
    }

    std::size_t size() const
    {
      return columns.size();
    }

    /** Append a row; its columns come in any order, equal ones are added up.
     * @param scratch kept from row to row, so that rows need no allocation */
    void add_row(std::span<const std::uint32_t> row_columns,
                 std::span<const double> row_coefficients,
                 std::vector<std::uint32_t> &scratch);

    /** result = matrix * vector; rows in a fixed order whatever the number of threads. */
    void multiply(std::span<const double> vector, std::span<double> result,
                  int threads) const;

    /** The entries on the diagonal, zero where there is none. */
    std::vector<double> diagonal() const;

    /** Largest |a_ij - a_ji| over the largest |a_ij|: 0 for a symmetric matrix. */
    double asymmetry() const;

    std::size_t bytes() const;
  };

  /** first_factor * first + second_factor * second. */
  CompressedRows sum_of(double first_factor, const CompressedRows &first,
                        double second_factor, const CompressedRows &second);
} // namespace meltfront::particles

#endif
