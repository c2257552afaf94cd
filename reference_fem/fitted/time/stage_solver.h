#ifndef meltfront_reference_fem_fitted_time_stage_solver_h
#define meltfront_reference_fem_fitted_time_stage_solver_h

#include <reference_fem/fitted/time/factorization.h>
#include <reference_fem/fitted/time/integrator.h>
#include <reference_fem/fitted/time/stage_equations.h>

#include <memory>

namespace meltfront::reference_fem::fitted
{
  /** The common pattern of the three Jacobians by rows with ascending columns. */
  class SortedPattern
  {
  public:
    explicit SortedPattern(const dealii::SparsityPattern &pattern);

    /** The entries of a matrix in the order of @p columns. */
    std::vector<double> values(const dealii::SparseMatrix<double> &matrix) const;

    std::vector<int> row_starts, columns;

  private:
    std::vector<int> destinations; ///< of the entries in deal.II's order
  };

  /** Corrections of the stages from a linearisation of a step's equations. */
  class StageSolver
  {
  public:
    virtual ~StageSolver() = default;

    /** Linearise at the given states and factorise. False where that is not possible. */
    virtual bool prepare(const StageEquations &equations, const Stages &u) = 0;

    /** The correction that annuls the linearised residual: -J^-1 G. */
    virtual void correct(const Stages &residual, Stages &correction) = 0;
  };

  /** The Jacobian of all stages as it is, one matrix of s N rows. */
  std::unique_ptr<StageSolver> make_exact_stage_solver(const ConservationProblem &problem,
                                                       IntegrationCost &cost);

  /**
   * One linearisation for all stages. With it the system falls apart along the
   * eigenvectors of B into one of N rows for each eigenvalue lambda,
   *
   *   lambda (M_u - F_rate) / h - F_u,
   *
   * of which those of conjugate pairs are solved once, in complex numbers (Hairer &
   * Wanner 1996, Solving ODEs II, section IV.8).
   */
  std::unique_ptr<StageSolver>
  make_frozen_stage_solver(const ConservationProblem &problem, IntegrationCost &cost);

  /** lambda (M_u - F_rate) / h - F_u. */
  template <typename Number>
  void assemble_shifted(const SortedPattern &pattern, const Linearisation &linearisation,
                        Number shift, double step, CompressedRows<Number> &matrix);
} // namespace meltfront::reference_fem::fitted

#endif
