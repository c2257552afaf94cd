#ifndef meltfront_reference_fem_enthalpy_lattice_matrix_h
#define meltfront_reference_fem_enthalpy_lattice_matrix_h

#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/lattice.h>

#include <algorithm>
#include <array>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * A symmetric matrix that couples each node of a lattice with its nearest neighbours,
   * diagonal ones included: the diagonal, and for each direction of half of the
   * neighbours the entries with the neighbour there. Neighbours are counted round the
   * ends of rows; where a direction is not periodic the entries there are zero.
   */
  class LatticeMatrix
  {
  public:
    using Direction = std::array<int, 3>;

    /** Couplings along the axes only, those of a network of conductances.
     * @throws std::logic_error if it has others */
    LatticeMatrix(const LatticeLevel &level, const ConductionMatrix &network);

    /** Take the entries of the network; as the constructor. */
    void take(const ConductionMatrix &network);

    /** Couplings with all neighbours, zero to begin with. */
    explicit LatticeMatrix(const LatticeLevel &level);

    /**
     * Make this P'A P of a finer matrix A, P the interpolation from this level without
     * the rows where the mask is zero.
     * @param diagonal of A, in the place of its own
     */
    void restrict_from(const LatticeMatrix &finer, const std::vector<double> &diagonal,
                       const char *mask);

    /** row_i -= (A x)_i for the nodes of a row, without the entries within the row. */
    void subtract_other_rows(int y, int z, const std::vector<double> &x,
                             double *row) const;

    /** (A x)_i but for the diagonal, of the entries within a row: neighbours along x. */
    double within_row(const double *coupling, const double *x, int i) const
    {
      const int last = level.row_length() - 1;
      const int before = i == 0 ? last : i - 1, after = i == last ? 0 : i + 1;
      return coupling[before] * x[before] + coupling[i] * x[after];
    }

    /** row_i -= (A x)_i for the nodes of a row. */
    void subtract_product(int y, int z, const std::vector<double> &diagonal,
                          const std::vector<double> &x, double *row) const;

    /** y -= A x. @param diagonal of A, in the place of its own */
    void subtract_product(const std::vector<double> &diagonal,
                          const std::vector<double> &x, std::vector<double> &y) const;

    /** P'(b - A x), without the rows where the mask is zero. */
    void restrict_residual(const std::vector<double> &diagonal, const char *mask,
                           const std::vector<double> &right_side,
                           const std::vector<double> &x,
                           std::vector<double> &on_coarse) const;

    /**
     * Gauss-Seidel: rows in turn, in each the even nodes, then the odd ones; the other
     * way round where not `forward`. relax(i, b) gives x_i, b being the right-hand side
     * less all couplings.
     */
    template <typename Relax>
    void sweep(bool forward, const std::vector<double> &right_side,
               std::vector<double> &x, const Relax &relax) const;

    std::vector<double> diagonal;

  private:
    void add_restricted(const LatticeMatrix &finer, const double *values,
                        const Direction &direction, double factor, const char *mask,
                        int y, int z);

    const LatticeLevel &level;
    std::vector<Direction> directions; ///< the first is that along x
    std::vector<std::vector<double>> couplings;
    mutable std::vector<double> row_work;
  };

  template <typename Relax>
  void LatticeMatrix::sweep(bool forward, const std::vector<double> &right_side,
                            std::vector<double> &x, const Relax &relax) const
  {
    const int nx = level.row_length(), ny = level.line[1].nodes(), rows = level.rows();
    row_work.resize(static_cast<std::size_t>(nx));
    double *const work = row_work.data();
    for(int k = 0; k < rows; ++k)
    {
      const int row = forward ? k : rows - 1 - k;
      const std::size_t first = std::size_t(row) * nx;
      std::copy_n(right_side.begin() + static_cast<std::ptrdiff_t>(first), nx, work);
      subtract_other_rows(row % ny, row / ny, x, work);
      double *const here = x.data() + first;
      const double *const coupling = couplings[0].data() + first;
      const int last_odd = nx - 1 - nx % 2, last_even = nx - 2 + nx % 2;
      const auto relax_node = [&](int i)
      { here[i] = relax(first + i, work[i] - within_row(coupling, here, i)); };
      if(forward)
      {
        for(int i = 0; i < nx; i += 2)
          relax_node(i);
        for(int i = 1; i < nx; i += 2)
          relax_node(i);
      }
      else
      {
        for(int i = last_odd; i > 0; i -= 2)
          relax_node(i);
        for(int i = last_even; i >= 0; i -= 2)
          relax_node(i);
      }
    }
  }
} // namespace meltfront::reference_fem

#endif
