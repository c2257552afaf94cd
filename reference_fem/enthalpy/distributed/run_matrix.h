#ifndef meltfront_reference_fem_enthalpy_distributed_run_matrix_h
#define meltfront_reference_fem_enthalpy_distributed_run_matrix_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace meltfront::reference_fem
{
  /** An entry of a row of a RunMatrix. */
  struct RunEntry
  {
    unsigned int column;
    double value;
  };

  /**
   * A sparse matrix between nodes of lattices, compressed by runs of rows that have the
   * same entries, with columns that go along with the rows: a product reads its vectors,
   * and next to nothing of the matrix.
   *
   * @tparam row_step, column_step how far rows and columns go on from one to the next
   */
  template <unsigned int row_step, unsigned int column_step>
  class RunMatrix
  {
  public:
    /** Rows come in the order in which products visit them. @param anew begins a run */
    void add_row(unsigned int row, const std::vector<RunEntry> &of_row, bool anew = false)
    {
      if(anew || !continues(row, of_row))
      {
        runs.push_back(
            {row, 0, entries.size(), static_cast<unsigned int>(of_row.size())});
        entries.insert(entries.end(), of_row.begin(), of_row.end());
      }
      ++runs.back().rows;
    }

    /** use(i, (A x)_i) of all rows. */
    template <typename Use>
    void multiply(const double *x, const Use &use) const
    {
      for(const Run &run : runs)
        sum_up(run.first_entry, run.entries, run.rows, x,
               [&](std::size_t t, double sum) { use(run.row + t * row_step, sum); });
    }

  protected:
    struct Run
    {
      unsigned int row, rows; ///< the first, and how many
      std::size_t first_entry;
      unsigned int entries;
    };

    bool continues(unsigned int row, const std::vector<RunEntry> &of_row) const
    {
      if(runs.empty())
        return false;
      const Run &run = runs.back();
      if(row != run.row + run.rows * row_step || of_row.size() != run.entries)
        return false;
      for(std::size_t k = 0; k < of_row.size(); ++k)
      {
        const RunEntry &entry = entries[run.first_entry + k];
        if(of_row[k].column != entry.column + run.rows * column_step
           || of_row[k].value != entry.value)
          return false;
      }
      return true;
    }

    /** use(t, sum) of the t-th of some rows of a run, over some of its entries. */
    template <typename Use>
    void sum_up(std::size_t first, unsigned int n, std::size_t rows, const double *x,
                const Use &use) const
    {
      switch(n)
      {
      case 1:
        return sum_up<1>(first, rows, x, use);
      case 2:
        return sum_up<2>(first, rows, x, use);
      case 4:
        return sum_up<4>(first, rows, x, use);
      case 6:
        return sum_up<6>(first, rows, x, use);
      case 9:
        return sum_up<9>(first, rows, x, use);
      default:
        for(std::size_t t = 0; t < rows; ++t)
        {
          double sum = 0;
          for(std::size_t k = first; k < first + n; ++k)
            sum += entries[k].value * x[entries[k].column + t * column_step];
          use(t, sum);
        }
      }
    }

    /** The same of a number of entries that is known to the compiler. */
    template <std::size_t n, typename Use>
    void sum_up(std::size_t first, std::size_t rows, const double *x,
                const Use &use) const
    {
      std::array<const double *, n> from;
      std::array<double, n> value;
      for(std::size_t k = 0; k < n; ++k)
      {
        from[k] = x + entries[first + k].column;
        value[k] = entries[first + k].value;
      }
      for(std::size_t t = 0; t < rows; ++t)
      {
        double sum = value[0] * from[0][t * column_step];
        for(std::size_t k = 1; k < n; ++k)
          sum += value[k] * from[k][t * column_step];
        use(t, sum);
      }
    }

    std::vector<Run> runs;
    std::vector<RunEntry> entries;
  };
} // namespace meltfront::reference_fem

#endif
