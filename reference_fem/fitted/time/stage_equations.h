#ifndef meltfront_reference_fem_fitted_time_stage_equations_h
#define meltfront_reference_fem_fitted_time_stage_equations_h

#include <reference_fem/fitted/conservation_problem.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** A vector of the problem for each stage of a step. */
  using Stages = std::vector<dealii::Vector<double>>;

  /** M, F and their derivatives at one state. */
  struct Linearisation
  {
    /** Matrices of zeros. */
    explicit Linearisation(const ConservationProblem &problem);

    dealii::Vector<double> mass, flow;
    dealii::SparseMatrix<double> mass_jacobian, flow_jacobian, rate_jacobian;
  };

  /**
   * The equations of a step of size h for the states U_j of its stages,
   *
   *   G_j = (sum_k B_jk M(U_k) + m_j) / h - F(sigma_j, U_j, V_j) = 0,
   *   V_j = (sum_k B_jk U_k + v_j) / h,
   *
   * which are those of Radau IIA with B the inverse of its matrix and
   * m_j = -sum_k B_jk M(u^n), and those of BDF with a single stage, B = alpha_0 and m the
   * weighted past. V_j and the divided difference of M are the same combination, so that
   * the sum of rows without F is an invariant.
   */
  class StageEquations
  {
  public:
    StageEquations(const ConservationProblem &problem,
                   dealii::FullMatrix<double> coupling, std::vector<double> clocks,
                   double step, Stages mass_offset, Stages rate_offset);

    unsigned int n_stages() const
    {
      return static_cast<unsigned int>(clocks.size());
    }

    /** G at the given states; flow() and rate() are those of these states from then on.
     */
    void evaluate(const Stages &u, Stages &residual);

    /** M, F and derivatives at the state of one stage. */
    void linearise(unsigned int stage, const Stages &u, Linearisation &result) const;

    const ConservationProblem &problem() const
    {
      return conservation;
    }

    /** B */
    const dealii::FullMatrix<double> &coupling() const
    {
      return matrix;
    }

    /** h */
    double step() const
    {
      return step_size;
    }

    /** F at each stage, as of the last evaluate(). */
    const Stages &flow() const
    {
      return flows;
    }

    /** V_j for the given states. */
    dealii::Vector<double> rate(unsigned int stage, const Stages &u) const;

  private:
    const ConservationProblem &conservation;
    dealii::FullMatrix<double> matrix;
    std::vector<double> clocks;
    double step_size;
    Stages mass_offset, rate_offset, masses, flows;
  };
} // namespace meltfront::reference_fem::fitted

#endif
