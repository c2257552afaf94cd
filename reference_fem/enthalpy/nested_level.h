#ifndef meltfront_reference_fem_enthalpy_nested_level_h
#define meltfront_reference_fem_enthalpy_nested_level_h

#include <reference_fem/enthalpy/conduction_matrix.h>

#include <cstddef>
#include <vector>

namespace meltfront::reference_fem
{
  class NestedMatrix;

  /** Rows of numbers, each with its column. */
  struct SparseRows
  {
    std::vector<std::size_t> start{0};
    std::vector<unsigned int> column;
    std::vector<double> value; ///< none where only the places matter

    std::size_t size() const
    {
      return start.size() - 1;
    }

    /** @param columns how many there are */
    SparseRows transposed(std::size_t columns) const;
  };

  /**
   * A level of nested meshes of any kind: the linear functions on the next coarser mesh
   * are among those on this one. Its nodes interpolate between those of the coarser level
   * with shares that sum up to one.
   */
  class NestedLevel
  {
  public:
    using Matrix = NestedMatrix;

    /** The finest one, of a mesh's nodes. */
    NestedLevel(const ConductionMatrix &network, int dimension);

    /** The next coarser one, with the couplings that this one leaves it. */
    NestedLevel coarser() const;

    /** @param shares by node, of those of the next coarser level */
    void interpolate_from(SparseRows shares, std::size_t nodes_of_coarser);

    std::size_t size() const
    {
      return couplings.size();
    }
    std::size_t coarse_size() const
    {
      return gathered.size();
    }
    bool in_space() const
    {
      return dimension > 2;
    }
    /** How often a coarser level is visited where fronts are moved. */
    int visits() const
    {
      return 2;
    }

    /** fine += P coarse, where the mask (none: everywhere) is not zero. */
    void add_interpolated(const std::vector<double> &on_coarse, const char *mask,
                          std::vector<double> &fine) const;

    /** P' of values, zero where the mask is. */
    void restrict_to(const std::vector<double> &fine, const char *mask,
                     std::vector<double> &on_coarse) const;

  private:
    friend NestedMatrix;

    explicit NestedLevel(int dimension)
      : dimension(dimension)
    {
    }

    int dimension;
    SparseRows couplings; ///< columns of a matrix on this level, but for the diagonal
    SparseRows shares;    ///< P; empty on the coarsest level
    SparseRows gathered;  ///< P'
  };

  /** A symmetric matrix on a nested level: the diagonal, and the other entries with their
   * sign changed, as conductances are. */
  class NestedMatrix
  {
  public:
    /** That of a network, which lives as long as this, on the finest level. */
    NestedMatrix(const NestedLevel &level, const ConductionMatrix &network);

    /** Zero to begin with. */
    explicit NestedMatrix(const NestedLevel &level);

    /** The network's conductances have changed. */
    void take(const ConductionMatrix &network)
    {
      diagonal = network.diagonal;
    }

    /**
     * Make this P'A P of a finer matrix A, P the interpolation from this level without
     * the rows where the mask is zero.
     * @param diagonal of A, in the place of its own
     */
    void restrict_from(const NestedMatrix &finer, const std::vector<double> &diagonal,
                       const char *mask);

    /** y -= A x. @param diagonal of A, in the place of its own */
    void subtract_product(const std::vector<double> &diagonal_of,
                          const std::vector<double> &x, std::vector<double> &y) const;

    /** P'(b - A x), without the rows where the mask is zero. */
    void restrict_residual(const std::vector<double> &diagonal_of, const char *mask,
                           const std::vector<double> &right_side,
                           const std::vector<double> &x,
                           std::vector<double> &on_coarse) const;

    /** Gauss-Seidel in the order of the nodes, or against it. relax(i, b) gives x_i, b
     * being the right-hand side less all couplings. */
    template <typename Relax>
    void sweep(bool forward, const std::vector<double> &right_side,
               std::vector<double> &x, const Relax &relax) const
    {
      const std::size_t n = level.size();
      for(std::size_t k = 0; k < n; ++k)
      {
        const std::size_t i = forward ? k : n - 1 - k;
        x[i] = relax(i, right_side[i] + from_others(i, x));
      }
    }

    std::vector<double> diagonal;

  private:
    double from_others(std::size_t i, const std::vector<double> &x) const
    {
      double sum = 0;
      for(std::size_t k = level.couplings.start[i]; k < level.couplings.start[i + 1]; ++k)
        sum += conductance[k] * x[level.couplings.column[k]];
      return sum;
    }

    const NestedLevel &level;
    std::vector<double> own;   ///< conductances, but on the finest level
    const double *conductance; ///< these, or the network's
  };
} // namespace meltfront::reference_fem

#endif
