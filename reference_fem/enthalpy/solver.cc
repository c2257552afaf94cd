#include <reference_fem/enthalpy/run.h>
#include <reference_fem/enthalpy/solver.h>

namespace meltfront::reference_fem
{
  cases::Cost run_enthalpy(const cases::Scene &scene, const cases::EffectSet &effects,
                           const cases::Resolution &resolution, cases::Observer &observer,
                           StepStatistics &statistics)
  {
    EnthalpyRun run(scene, effects, resolution);
    return run.run(observer, statistics);
  }
} // namespace meltfront::reference_fem
