#ifndef meltfront_reference_fem_enthalpy_distributed_rank_solver_h
#define meltfront_reference_fem_enthalpy_distributed_rank_solver_h

#include <reference_fem/enthalpy/distributed/rank_level.h>
#include <reference_fem/enthalpy/linear_solver.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Conjugate gradients on several ranks, preconditioned by RankMultigrid. Vectors have
   * the own nodes of a rank; solutions have ghosts, too, which are left at zero.
   */
  std::unique_ptr<LinearSolver> make_rank_solver(const std::vector<RankLevel> &levels,
                                                 Traffic &traffic);
} // namespace meltfront::reference_fem

#endif
