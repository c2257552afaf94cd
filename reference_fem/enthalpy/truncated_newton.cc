#include <reference_fem/enthalpy/curved_graph.h>
#include <reference_fem/enthalpy/truncated_newton.templates.h>

namespace meltfront::reference_fem
{
  std::unique_ptr<NonlinearSolver>
  make_nonlinear_solver(const StepProblem &problem, const cases::Material &material,
                        const cases::EffectSet &effects,
                        std::unique_ptr<LinearSolver> linear_solver)
  {
    if(material.curves && material.curves->jump() > 0)
      return make_truncated_newton<CurvedGraph<true>>(
          problem, material, std::move(linear_solver), WholeMesh());
    if(material.curves)
      return make_truncated_newton<CurvedGraph<false>>(
          problem, material, std::move(linear_solver), WholeMesh());
    return make_truncated_newton(problem, material, effects, std::move(linear_solver),
                                 WholeMesh());
  }
} // namespace meltfront::reference_fem
