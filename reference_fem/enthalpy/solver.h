#ifndef meltfront_reference_fem_enthalpy_solver_h
#define meltfront_reference_fem_enthalpy_solver_h

#include <cases/method.h>
#include <cases/scene.h>

namespace meltfront::reference_fem
{
  /** Worst values over the steps of a run. */
  struct StepStatistics
  {
    double graph_inconsistency = 0; ///< see StepOutcome::graph_inconsistency
    double balance_defect = 0;      ///< of one step, over the heat at hand
    int iterations = 0;
    long halvings = 0;    ///< steps that were halved
    long euler_steps = 0; ///< steps that BDF2 left to backward Euler
  };

  /** The largest relative defect of a step's heat balance that is accepted. */
  inline constexpr double accepted_balance_defect = 1e-13;

  /**
   * Run a scene by the enthalpy method (see README.md): what Method::solve of
   * `fem-enthalpy` does, with the worst values of its checks.
   */
  cases::Cost run_enthalpy(const cases::Scene &scene, const cases::EffectSet &effects,
                           const cases::Resolution &resolution, cases::Observer &observer,
                           StepStatistics &statistics);
} // namespace meltfront::reference_fem

#endif
