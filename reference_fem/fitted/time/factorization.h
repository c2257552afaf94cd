#ifndef meltfront_reference_fem_fitted_time_factorization_h
#define meltfront_reference_fem_fitted_time_factorization_h

#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** A square sparse matrix by rows, the columns of each row in ascending order. */
  template <typename Number>
  struct CompressedRows
  {
    std::vector<int> row_starts; ///< one more than there are rows
    std::vector<int> columns;
    std::vector<Number> values;

    int n_rows() const
    {
      return static_cast<int>(row_starts.size()) - 1;
    }
  };

  /**
   * LU factors of a sparse matrix whose pattern never changes, for double and
   * std::complex<double>: UMFPACK (Davis 2004, ACM TOMS 30, 196-199), which orders the
   * rows once and factorises any number of times.
   */
  template <typename Number>
  class Factorisation
  {
  public:
    Factorisation() = default;
    Factorisation(const Factorisation &) = delete;
    Factorisation &operator=(const Factorisation &) = delete;
    ~Factorisation();

    /** Factorise. False where the matrix is singular or holds a value that is not
     * finite. The matrix must stay as it is while it is solved with.
     * @throws std::bad_alloc where the factors do not fit into memory. */
    bool factorise(const CompressedRows<Number> &matrix);

    /** x = matrix^-1 b. */
    void solve(const std::vector<Number> &b, std::vector<Number> &x) const;

    /** Entries of both factors. */
    long n_entries() const
    {
      return entries;
    }

  private:
    void free_numeric();

    const CompressedRows<Number> *matrix = nullptr;
    void *symbolic = nullptr;
    void *numeric = nullptr;
    long entries = 0;
  };
} // namespace meltfront::reference_fem::fitted

#endif
