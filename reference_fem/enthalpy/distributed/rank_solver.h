#ifndef meltfront_reference_fem_enthalpy_distributed_rank_solver_h
#define meltfront_reference_fem_enthalpy_distributed_rank_solver_h

#include <reference_fem/enthalpy/distributed/rank_level.h>
#include <reference_fem/enthalpy/linear_solver.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /** What a run on several ranks has sent, for a model of what it would on more: numbers
   * of one rank. */
  struct Traffic
  {
    long exchanges = 0;  ///< of ghost values with all neighbours
    long reductions = 0; ///< over all ranks
    double sent = 0;     ///< numbers to neighbours

    template <class Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &exchanges &reductions &sent;
    }
  };

  /**
   * Conjugate gradients on several ranks, preconditioned by one V-cycle of geometric
   * multigrid. All vectors have the own nodes of a rank.
   *
   * Smoother: sweeps of Gauss-Seidel over a rank's own nodes with the other ranks' values
   * as they were, before the coarse correction forwards, after it backwards, so that the
   * cycle is symmetric. Truncated as in LatticeMultigrid (Kornhuber 1994): corrections
   * vanish at inactive nodes. On coarse meshes K is that of their own cells, and D the
   * row sums of P'D P, an inactive node counting with K_ii: the energy that it costs to
   * be held. The coarsest system is solved directly, on every rank.
   */
  std::unique_ptr<LinearSolver> make_rank_solver(const std::vector<RankLevel> &levels,
                                                 Traffic &traffic);
} // namespace meltfront::reference_fem

#endif
