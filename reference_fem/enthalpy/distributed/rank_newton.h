#ifndef meltfront_reference_fem_enthalpy_distributed_rank_newton_h
#define meltfront_reference_fem_enthalpy_distributed_rank_newton_h

#include <reference_fem/enthalpy/distributed/rank_level.h>
#include <reference_fem/enthalpy/truncated_newton.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * NonlinearSolver on several ranks: vectors have the rank's own nodes, u its ghosts,
   * too. All decisions are taken from sums and maxima over all ranks, so that all ranks
   * take them alike. Sweeps are of Gauss-Seidel within a rank and of Jacobi between
   * ranks: nodes of other ranks stand still in half a sweep.
   *
   * @param problem conduction has ghosts in its columns
   */
  std::unique_ptr<NonlinearSolver>
  make_rank_newton(const StepProblem &problem, const std::vector<RankLevel> &levels,
                   const cases::Material &material, const cases::EffectSet &effects,
                   std::unique_ptr<LinearSolver> linear_solver, Traffic &traffic);
} // namespace meltfront::reference_fem

#endif
