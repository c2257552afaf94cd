#include <reference_fem/enthalpy/distributed/rank_newton.h>
#include <reference_fem/enthalpy/distributed/sharing_ranks.h>
#include <reference_fem/enthalpy/truncated_newton.templates.h>

namespace meltfront::reference_fem
{
  std::unique_ptr<NonlinearSolver>
  make_rank_newton(const StepProblem &problem, const std::vector<RankLevel> &levels,
                   const cases::Material &material, const cases::EffectSet &effects,
                   std::unique_ptr<LinearSolver> linear_solver, Traffic &traffic)
  {
    return make_truncated_newton(problem, material, effects, std::move(linear_solver),
                                 SharingRanks(levels, problem.conduction, traffic));
  }
} // namespace meltfront::reference_fem
