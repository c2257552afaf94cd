#ifndef meltfront_reference_fem_enthalpy_distributed_coarsest_solver_h
#define meltfront_reference_fem_enthalpy_distributed_coarsest_solver_h

#include <reference_fem/enthalpy/distributed/rank_level.h>

#include <Eigen/SparseCholesky>

#include <vector>

namespace meltfront::reference_fem
{
  /** The linear system of the coarsest mesh, which every rank has and solves as a whole.
   */
  class CoarsestSolver
  {
  public:
    explicit CoarsestSolver(const RankLevel &level);

    /** Take D of D + K. @param diagonal of the own nodes */
    void take(const std::vector<double> &diagonal);

    /** x at the own nodes, zero where a wall prescribes values. */
    void solve(const std::vector<double> &right_side, std::vector<double> &x);

  private:
    /** Of all nodes, by their numbers on the lattice. */
    const Eigen::VectorXd &gather(const std::vector<double> &values);

    const RankLevel &level;
    Eigen::SparseMatrix<double> stiffness, matrix;
    Eigen::VectorXd gathered, solution;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
  };
} // namespace meltfront::reference_fem

#endif
