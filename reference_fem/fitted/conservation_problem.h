#ifndef meltfront_reference_fem_fitted_conservation_problem_h
#define meltfront_reference_fem_fitted_conservation_problem_h

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <string>

namespace meltfront::reference_fem::fitted
{
  /**
   * A conservation law discretised in space on a mesh that moves with the solution:
   *
   *   d/dsigma M(u) = F(sigma, u, du/dsigma),
   *
   * with sigma the clock of the time integration (time itself, or its root: the problem
   * knows how time follows from it). u holds temperatures, front displacements and the
   * heat accounts of the walls; M the heat that each test function weighs; F depends on
   * du/dsigma through the velocity of the mesh. Rows that are constraints have M = 0 and
   * ask for F = 0.
   *
   * An account is an unknown Q that appears linearly in M (as M_a - Q_a in the row of a
   * wall node, or alone in a row of its own), so that the sum of M over all rows of heat
   * is an invariant that every linear time scheme keeps to the tolerance of its solver.
   */
  class ConservationProblem
  {
  public:
    virtual ~ConservationProblem() = default;

    /** Number of unknowns and of rows. */
    virtual unsigned int size() const = 0;

    /** Which columns the three Jacobians have in common: one pattern for all. */
    virtual const dealii::SparsityPattern &sparsity() const = 0;

    /** M(u) and F(sigma, u, rate). */
    virtual void evaluate(double clock, const dealii::Vector<double> &u,
                          const dealii::Vector<double> &rate,
                          dealii::Vector<double> &mass,
                          dealii::Vector<double> &flow) const = 0;

    /** dM/du, dF/du and dF/drate, and the values of evaluate() with them. The matrices
     * have been initialised with sparsity(). */
    virtual void linearise(double clock, const dealii::Vector<double> &u,
                           const dealii::Vector<double> &rate,
                           dealii::Vector<double> &mass, dealii::Vector<double> &flow,
                           dealii::SparseMatrix<double> &mass_jacobian,
                           dealii::SparseMatrix<double> &flow_jacobian,
                           dealii::SparseMatrix<double> &rate_jacobian) const = 0;

    /** The size of each unknown against which changes of it are judged; positive. */
    virtual dealii::Vector<double> scale(const dealii::Vector<double> &u) const = 0;

    /** Empty for a state on which the equations have a meaning; else what is wrong with
     * it: a front outside the domain, an inverted element. */
    virtual std::string reason_invalid(const dealii::Vector<double> &u) const = 0;
  };
} // namespace meltfront::reference_fem::fitted

#endif
