#include <reference_fem/fitted/time/stage_equations.h>

#include <utility>

namespace meltfront::reference_fem::fitted
{
  Linearisation::Linearisation(const ConservationProblem &problem)
    : mass(problem.size())
    , flow(problem.size())
    , mass_jacobian(problem.sparsity())
    , flow_jacobian(problem.sparsity())
    , rate_jacobian(problem.sparsity())
  {
  }

  StageEquations::StageEquations(const ConservationProblem &problem,
                                 dealii::FullMatrix<double> coupling,
                                 std::vector<double> clocks, const double step,
                                 Stages mass_offset, Stages rate_offset)
    : conservation(problem)
    , matrix(std::move(coupling))
    , clocks(std::move(clocks))
    , step_size(step)
    , mass_offset(std::move(mass_offset))
    , rate_offset(std::move(rate_offset))
    , masses(n_stages(), dealii::Vector<double>(problem.size()))
    , flows(masses)
  {
  }

  dealii::Vector<double> StageEquations::rate(const unsigned int stage,
                                              const Stages &u) const
  {
    dealii::Vector<double> result = rate_offset[stage];
    for(unsigned int k = 0; k < n_stages(); ++k)
      result.add(matrix(stage, k), u[k]);
    result /= step_size;
    return result;
  }

  void StageEquations::evaluate(const Stages &u, Stages &residual)
  {
    for(unsigned int j = 0; j < n_stages(); ++j)
      conservation.evaluate(clocks[j], u[j], rate(j, u), masses[j], flows[j]);
    residual = mass_offset;
    for(unsigned int j = 0; j < n_stages(); ++j)
    {
      for(unsigned int k = 0; k < n_stages(); ++k)
        residual[j].add(matrix(j, k), masses[k]);
      residual[j] /= step_size;
      residual[j] -= flows[j];
    }
  }

  void StageEquations::linearise(const unsigned int stage, const Stages &u,
                                 Linearisation &result) const
  {
    result.mass_jacobian = 0.;
    result.flow_jacobian = 0.;
    result.rate_jacobian = 0.;
    conservation.linearise(clocks[stage], u[stage], rate(stage, u), result.mass,
                           result.flow, result.mass_jacobian, result.flow_jacobian,
                           result.rate_jacobian);
  }
} // namespace meltfront::reference_fem::fitted
