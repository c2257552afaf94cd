#ifndef meltfront_reference_fem_enthalpy_distributed_conduction_runs_h
#define meltfront_reference_fem_enthalpy_distributed_conduction_runs_h

#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/distributed/run_matrix.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * A network of conductances between the nodes of a lattice that a rank has, as
   * ConductionMatrix is one: (K u)_i = K_ii u_i - (A u)_i, A being the matrix of the
   * runs. Rows are the rank's own nodes, in turn; columns beyond them are ghosts.
   *
   * Sweeps of Gauss-Seidel take the runs in turn, in each every other node from the first
   * on, then those between, none of which waits for the one before it. Ghosts stand
   * still.
   */
  class ConductionRuns : public RunMatrix<1, 1>
  {
  public:
    std::vector<double> diagonal; ///< K_ii

    /** The next node and its conductances, in the order of columns. */
    void add_node(const std::vector<RunEntry> &conductances);

    /** To be called after the last node. */
    void close();

    /** Entries of K, the diagonal included: what one product touches. */
    long n_entries() const
    {
      return count;
    }

    /** All entries one by one. */
    ConductionMatrix expanded() const;

    /** Relax all nodes: x_i = relax(i, b_i + (A x)_i), backwards where not `forward`. */
    template <typename Relax>
    void sweep(bool forward, const double *b, double *x, const Relax &relax) const;

    /** x = the forward sweep from zero of a linear system, x_i = inverse_i (b_i + ...);
     * ghosts count as zero. */
    void sweep_from_zero(const double *b, const double *inverse, double *x) const;

    /** What the system's equations lack after sweep_from_zero(), where inverse is not
     * zero: the conduction from nodes that were relaxed after their own, and from ghosts,
     * which are up to date. */
    void residual_of_sweep(const double *x, const double *inverse,
                           double *residual) const;

  private:
    /** How sweeps see a run: its first entries are with nodes of runs before it, then
     * those with other runs, then, of a pair, those with the nodes before and after. */
    struct Order
    {
      unsigned int earlier, others;
      bool paired;       ///< else all its nodes have no other of the run beside them
      double within = 0; ///< conductance along a paired run
    };

    std::vector<Order> orders;
    long count = 0;
    mutable std::vector<double> work; ///< of a run
  };

  template <typename Relax>
  void ConductionRuns::sweep(bool forward, const double *b, double *x,
                             const Relax &relax) const
  {
    for(std::size_t k = 0; k < runs.size(); ++k)
    {
      const std::size_t r = forward ? k : runs.size() - 1 - k;
      const Run &run = runs[r];
      const Order &order = orders[r];
      double *const here = x + run.row, *const supply = work.data();
      const double *const right_side = b + run.row;
      sum_up(run.first_entry, order.others, run.rows, x,
             [&](std::size_t t, double sum) { supply[t] = right_side[t] + sum; });
      const std::size_t n = run.rows;
      if(!order.paired)
      {
        for(std::size_t t = 0; t < n; ++t)
          here[t] = relax(run.row + t, supply[t]);
        continue;
      }
      const auto relax_node = [&](std::size_t t)
      {
        here[t] = relax(run.row + t,
                        supply[t] + order.within * (*(here + t - 1) + here[t + 1]));
      };
      for(const std::size_t first : {forward ? 0u : 1u, forward ? 1u : 0u})
        for(std::size_t t = first; t < n; t += 2)
          relax_node(t);
    }
  }
} // namespace meltfront::reference_fem

#endif
