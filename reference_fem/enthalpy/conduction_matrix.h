#ifndef meltfront_reference_fem_enthalpy_conduction_matrix_h
#define meltfront_reference_fem_enthalpy_conduction_matrix_h

#include <reference_fem/enthalpy/compensated_vector.h>

#include <cstddef>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * The stiffness matrix K of unit conductivity as a network of conductances g_ij = -K_ij
   * between nodes, compressed by rows without the diagonal: since the rows of K sum to
   * zero, (K u)_i = -sum_j g_ij (u_j - u_i). Both rows of a pair hold the same bits, so
   * what leaves one node enters the other.
   */
  class ConductionMatrix
  {
  public:
    std::vector<std::size_t> row_start{0};
    std::vector<unsigned int> column;
    std::vector<double> conductance;
    std::vector<double> diagonal; ///< K_ii

    std::size_t size() const
    {
      return diagonal.size();
    }

    /** Entries of K, the diagonal included: what one product touches. */
    long entries() const
    {
      return static_cast<long>(column.size() + diagonal.size());
    }

    /** -(K u)_i, the heat flow into node i (W in the measure of the scene). */
    double inflow(std::size_t i, const CompensatedVector &u) const
    {
      double sum = 0;
      for(std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
        sum += conductance[k] * u.difference(column[k], i);
      return sum;
    }

    /** The same of plain numbers. */
    double inflow(std::size_t i, const std::vector<double> &u) const
    {
      double sum = 0;
      for(std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
        sum += conductance[k] * (u[column[k]] - u[i]);
      return sum;
    }

    /** The same with the cancellation between neighbours kept to the last digit: heat
     * flows through a node of a good conductor many times over what it stores. */
    long double exact_inflow(std::size_t i, const CompensatedVector &u) const
    {
      cases::CompensatedSum sum;
      for(std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
        u.add_difference(column[k], i, conductance[k], sum);
      return sum.extended();
    }

    /** (K v)_i. */
    double product(std::size_t i, const std::vector<double> &v) const
    {
      double sum = diagonal[i] * v[i];
      for(std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
        sum -= conductance[k] * v[column[k]];
      return sum;
    }

    /**
     * Make this the network of another matrix with every conductance multiplied by a
     * factor of its two nodes; `factor(i, j)` is to be symmetric.
     */
    template <typename Factor>
    void weigh(const ConductionMatrix &unit, const Factor &factor)
    {
      for(std::size_t i = 0; i < size(); ++i)
      {
        diagonal[i] = 0;
        for(std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
        {
          conductance[k] = unit.conductance[k] * factor(i, column[k]);
          diagonal[i] += conductance[k];
        }
      }
    }

    /** True where no conductance is negative: the discrete maximum principle holds. */
    bool is_monotone() const
    {
      for(std::size_t i = 0; i < size(); ++i)
        for(std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
          if(conductance[k] < -1e-12 * diagonal[i])
            return false;
      return true;
    }
  };
} // namespace meltfront::reference_fem

#endif
