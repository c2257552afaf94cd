#include <reference_fem/enthalpy/distributed/coarsest_solver.h>

#include <deal.II/base/mpi.h>

namespace meltfront::reference_fem
{
  CoarsestSolver::CoarsestSolver(const RankLevel &level)
    : level(level)
  {
    // Each rank fills in its rows, each with room for the neighbours on a lattice; what
    // there is no neighbour for stays an entry of the diagonal, zero.
    constexpr std::size_t room = 7;
    const std::size_t n_all = level.lattice.n_nodes();
    std::vector<double> free(n_all), column(room * n_all), value(room * n_all);
    const ConductionMatrix own = level.conduction.expanded();
    for(unsigned int i = 0; i < level.n_own(); ++i)
    {
      const std::size_t number = level.number(i);
      std::size_t at = room * number;
      free[number] = level.free[i];
      for(std::size_t k = at; k < at + room; ++k)
        column[k] = static_cast<double>(number);
      value[at++] = level.free[i] ? own.diagonal[i] : 1;
      for(std::size_t k = own.row_start[i]; k < own.row_start[i + 1]; ++k, ++at)
      {
        column[at] = static_cast<double>(level.number(own.column[k]));
        value[at] = -own.conductance[k];
      }
    }
    for(std::vector<double> *part : {&free, &column, &value})
      dealii::Utilities::MPI::sum(*part, level.communicator, *part);
    std::vector<Eigen::Triplet<double>> entries;
    for(std::size_t k = 0; k < column.size(); ++k)
    {
      const std::size_t i = k / room, j = static_cast<std::size_t>(column[k]);
      if(i == j || (free[i] > 0 && free[j] > 0))
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value[k]);
    }
    const auto n = static_cast<Eigen::Index>(n_all);
    stiffness.resize(n, n);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    matrix = stiffness;
    factors.analyzePattern(matrix);
    gathered.resize(n);
  }

  const Eigen::VectorXd &CoarsestSolver::gather(const std::vector<double> &values)
  {
    gathered.setZero();
    for(unsigned int i = 0; i < level.n_own(); ++i)
      gathered[static_cast<Eigen::Index>(level.number(i))]
          = level.free[i] ? values[i] : 0;
    const dealii::ArrayView<double> all(gathered.data(),
                                        static_cast<std::size_t>(gathered.size()));
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all), level.communicator,
                                all);
    return gathered;
  }

  void CoarsestSolver::take(const std::vector<double> &diagonal)
  {
    matrix = stiffness;
    matrix.diagonal() += gather(diagonal);
    factors.factorize(matrix);
  }

  void CoarsestSolver::solve(const std::vector<double> &right_side,
                             std::vector<double> &x)
  {
    solution = factors.solve(gather(right_side));
    for(unsigned int i = 0; i < level.n_own(); ++i)
      x[i] = solution[static_cast<Eigen::Index>(level.number(i))];
  }
} // namespace meltfront::reference_fem
