#include <reference_fem/enthalpy/distributed/rank_solver.h>

#include <deal.II/base/mpi.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    /** The coarsest system, which every rank solves. */
    class CoarsestSolver
    {
    public:
      explicit CoarsestSolver(const RankLevel &level);

      /** Take D of D + K. */
      void take(const RankVector &diagonal);

      void solve(const RankVector &right_side, RankVector &x);

    private:
      /** Of all nodes, by their global number. */
      const Eigen::VectorXd &gather(const RankVector &values);

      const RankLevel &level;
      Eigen::SparseMatrix<double> stiffness, matrix;
      Eigen::VectorXd gathered, solution;
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
    };

    CoarsestSolver::CoarsestSolver(const RankLevel &level)
      : level(level)
    {
      const auto n = static_cast<Eigen::Index>(level.nodes->size());
      // Each rank fills in its rows, each with room for the neighbours on a lattice; what
      // there is no neighbour for stays an entry of the diagonal, zero.
      constexpr std::size_t room = 7;
      const auto n_all = static_cast<std::size_t>(n);
      const auto global = [&](std::size_t i)
      {
        return static_cast<std::size_t>(
            level.nodes->local_to_global(static_cast<unsigned int>(i)));
      };
      std::vector<double> free(n_all), column(room * n_all), value(room * n_all);
      const ConductionMatrix &own = level.conduction;
      for(std::size_t i = 0; i < level.n_own(); ++i)
      {
        std::size_t at = room * global(i);
        free[global(i)] = level.free[i];
        for(std::size_t k = at; k < at + room; ++k)
          column[k] = static_cast<double>(global(i));
        value[at++] = level.free[i] ? own.diagonal[i] : 1;
        for(std::size_t k = own.row_start[i]; k < own.row_start[i + 1]; ++k, ++at)
        {
          column[at] = static_cast<double>(global(own.column[k]));
          value[at] = -own.conductance[k];
        }
      }
      for(std::vector<double> *part : {&free, &column, &value})
        dealii::Utilities::MPI::sum(*part, level.communicator(), *part);
      std::vector<Eigen::Triplet<double>> entries;
      for(std::size_t k = 0; k < column.size(); ++k)
      {
        const std::size_t i = k / room, j = static_cast<std::size_t>(column[k]);
        if(i == j || (free[i] > 0 && free[j] > 0))
          entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value[k]);
      }
      stiffness.resize(n, n);
      stiffness.setFromTriplets(entries.begin(), entries.end());
      matrix = stiffness;
      factors.analyzePattern(matrix);
      gathered.resize(n);
    }

    const Eigen::VectorXd &CoarsestSolver::gather(const RankVector &values)
    {
      gathered.setZero();
      for(unsigned int i = 0; i < level.n_own(); ++i)
        gathered[static_cast<Eigen::Index>(level.nodes->local_to_global(i))]
            = level.free[i] ? values.local_element(i) : 0;
      const dealii::ArrayView<double> all(gathered.data(),
                                          static_cast<std::size_t>(gathered.size()));
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all),
                                  level.communicator(), all);
      return gathered;
    }

    void CoarsestSolver::take(const RankVector &diagonal)
    {
      matrix = stiffness;
      matrix.diagonal() += gather(diagonal);
      factors.factorize(matrix);
    }

    void CoarsestSolver::solve(const RankVector &right_side, RankVector &x)
    {
      solution = factors.solve(gather(right_side));
      for(unsigned int i = 0; i < level.n_own(); ++i)
        x.local_element(i)
            = solution[static_cast<Eigen::Index>(level.nodes->local_to_global(i))];
    }

    class RankSolver : public LinearSolver
    {
    public:
      RankSolver(const std::vector<RankLevel> &levels, Traffic &traffic);

      std::string description() const override
      {
        return "conjugate gradients, geometric multigrid with truncation, Gauss-Seidel "
               "on each rank";
      }

      void solve(const NewtonSystem &system, double reduction,
                 std::vector<double> &x) override;

    private:
      /** Of a level: A = D + K on its active nodes. */
      struct System
      {
        RankVector diagonal;         ///< D
        RankVector inverse_diagonal; ///< of A; zero where inactive
        RankVector right_side, x, residual;
      };

      void set_up(const NewtonSystem &system, double scale);
      void exchange(const RankLevel &level, const RankVector &values);
      double product(const RankVector &a, const RankVector &b);
      void multiply(const RankVector &x, RankVector &y);
      void sweep_from_zero(std::size_t l, const RankVector &right_side, RankVector &x);
      void subtract_product(std::size_t l, const RankVector &right_side,
                            const RankVector &x, RankVector &residual);
      void sweep_back(std::size_t l, const RankVector &right_side, RankVector &x);
      void cycle(std::size_t l, const RankVector &right_side, RankVector &x);

      const std::vector<RankLevel> &levels;
      Traffic &traffic;
      std::vector<System> systems;
      CoarsestSolver coarsest;
      RankVector residual, preconditioned, direction, image;
      long entries_of_levels = 0;
    };

    RankSolver::RankSolver(const std::vector<RankLevel> &levels, Traffic &traffic)
      : levels(levels)
      , traffic(traffic)
      , systems(levels.size())
      , coarsest(levels.back())
    {
      for(std::size_t l = 0; l < levels.size(); ++l)
      {
        System &system = systems[l];
        system.diagonal.reinit(levels[l].nodes);
        system.inverse_diagonal.reinit(levels[l].nodes);
        system.residual.reinit(levels[l].nodes);
        if(l > 0)
        {
          system.right_side.reinit(levels[l].nodes);
          system.x.reinit(levels[l].nodes);
        }
        entries_of_levels += levels[l].conduction.entries();
      }
      for(RankVector *vector : {&residual, &preconditioned, &direction, &image})
        vector->reinit(levels.front().nodes);
    }

    void RankSolver::exchange(const RankLevel &level, const RankVector &values)
    {
      values.update_ghost_values();
      ++traffic.exchanges;
      traffic.sent += level.nodes->n_import_indices();
    }

    double RankSolver::product(const RankVector &a, const RankVector &b)
    {
      // Four sums, since one waits for its own last addition.
      std::array<double, 4> sums{};
      const std::size_t n = levels.front().n_own();
      const double *x = a.begin(), *y = b.begin();
      std::size_t i = 0;
      for(; i + 4 <= n; i += 4)
        for(std::size_t k = 0; k < 4; ++k)
          sums[k] += x[i + k] * y[i + k];
      for(; i < n; ++i)
        sums[0] += x[i] * y[i];
      ++traffic.reductions;
      return dealii::Utilities::MPI::sum((sums[0] + sums[1]) + (sums[2] + sums[3]),
                                         levels.front().communicator());
    }

    void RankSolver::set_up(const NewtonSystem &of_step, double scale)
    {
      for(std::size_t l = 0; l < levels.size(); ++l)
      {
        const RankLevel &level = levels[l];
        System &system = systems[l];
        if(l == 0)
          for(unsigned int i = 0; i < level.n_own(); ++i)
            system.diagonal.local_element(i)
                = of_step.active[i] ? of_step.heat_capacity[i] * scale
                  : level.free[i]   ? level.conduction.diagonal[i]
                                    : 0;
        else
        {
          system.diagonal = 0;
          levels[l - 1].coarser->restrict_to(systems[l - 1].diagonal, system.diagonal);
        }
        for(unsigned int i = 0; i < level.n_own(); ++i)
        {
          const bool active = l == 0 ? of_step.active[i] : level.free[i];
          system.inverse_diagonal.local_element(i)
              = active ? 1
                             / (system.diagonal.local_element(i)
                                + level.conduction.diagonal[i])
                       : 0;
        }
      }
      coarsest.take(systems.back().diagonal);
      ++traffic.reductions;
    }

    /** y = A x, zero where inactive, where x is to be zero. */
    void RankSolver::multiply(const RankVector &x, RankVector &y)
    {
      const RankLevel &level = levels.front();
      const System &system = systems.front();
      exchange(level, x);
      const ConductionMatrix &k = level.conduction;
      const double *values = x.begin(), *d = system.diagonal.begin(),
                   *inverse = system.inverse_diagonal.begin();
      double *result = y.begin();
      for(std::size_t i = 0; i < level.n_own(); ++i)
      {
        double sum = (d[i] + k.diagonal[i]) * values[i];
        for(std::size_t e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
          sum -= k.conductance[e] * values[k.column[e]];
        result[i] = inverse[i] > 0 ? sum : 0;
      }
    }

    void RankSolver::sweep_from_zero(std::size_t l, const RankVector &right_side,
                                     RankVector &x)
    {
      x = 0;
      x.zero_out_ghost_values();
      const RankLevel &level = levels[l];
      const ConductionMatrix &k = level.conduction;
      const double *inverse = systems[l].inverse_diagonal.begin(),
                   *b = right_side.begin();
      double *values = x.begin();
      for(std::size_t i = 0; i < level.n_own(); ++i)
      {
        double sum = b[i];
        for(std::size_t e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
          sum += k.conductance[e] * values[k.column[e]];
        values[i] = inverse[i] * sum;
      }
    }

    void RankSolver::subtract_product(std::size_t l, const RankVector &right_side,
                                      const RankVector &x, RankVector &result)
    {
      const RankLevel &level = levels[l];
      exchange(level, x);
      const ConductionMatrix &k = level.conduction;
      const double *d = systems[l].diagonal.begin(),
                   *inverse = systems[l].inverse_diagonal.begin(),
                   *b = right_side.begin(), *values = x.begin();
      double *left = result.begin();
      for(std::size_t i = 0; i < level.n_own(); ++i)
      {
        double sum = b[i] - (d[i] + k.diagonal[i]) * values[i];
        for(std::size_t e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
          sum += k.conductance[e] * values[k.column[e]];
        left[i] = inverse[i] > 0 ? sum : 0;
      }
    }

    void RankSolver::sweep_back(std::size_t l, const RankVector &right_side,
                                RankVector &x)
    {
      const RankLevel &level = levels[l];
      exchange(level, x);
      const ConductionMatrix &k = level.conduction;
      const double *inverse = systems[l].inverse_diagonal.begin(),
                   *b = right_side.begin();
      double *values = x.begin();
      for(std::size_t i = level.n_own(); i-- > 0;)
      {
        double sum = b[i];
        for(std::size_t e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
          sum += k.conductance[e] * values[k.column[e]];
        values[i] = inverse[i] * sum;
      }
    }

    void RankSolver::cycle(std::size_t l, const RankVector &right_side, RankVector &x)
    {
      if(l + 1 == levels.size() && l > 0)
      {
        coarsest.solve(right_side, x);
        ++traffic.reductions;
        return;
      }
      sweep_from_zero(l, right_side, x);
      if(l + 1 < levels.size())
      {
        subtract_product(l, right_side, x, systems[l].residual);
        System &below = systems[l + 1];
        below.right_side = 0;
        levels[l].coarser->restrict_to(systems[l].residual, below.right_side);
        cycle(l + 1, below.right_side, below.x);
        RankVector &correction = systems[l].residual;
        correction = 0;
        levels[l].coarser->interpolate(below.x, correction);
        // A transfer exchanges on the fine and on the coarse side.
        traffic.exchanges += 4;
        traffic.sent += 2
                        * (levels[l].nodes->n_import_indices()
                           + levels[l + 1].nodes->n_import_indices());
        x.zero_out_ghost_values();
        const double *inverse = systems[l].inverse_diagonal.begin(),
                     *change = correction.begin();
        double *values = x.begin();
        for(std::size_t i = 0; i < levels[l].n_own(); ++i)
          if(inverse[i] > 0)
            values[i] += change[i];
      }
      sweep_back(l, right_side, x);
    }

    void RankSolver::solve(const NewtonSystem &system, double reduction,
                           std::vector<double> &x)
    {
      // Stopping early is safe: the outer iteration goes on until the graph holds.
      constexpr int most_iterations = 200;
      // Of a product; of a cycle over all levels.
      constexpr long passes_of_cycle = 4;
      const double scale = 1 / system.step_factor;
      const std::size_t n = levels.front().n_own();
      for(unsigned int i = 0; i < n; ++i)
        residual.local_element(i) = system.active[i] ? system.residual[i] * scale : 0;
      std::fill(x.begin(), x.end(), 0);
      const double start = std::sqrt(product(residual, residual));
      const double enough
          = std::max(reduction * start, system.sufficient_residual * scale);
      if(start <= enough)
        return;
      set_up(system, scale);
      direction.zero_out_ghost_values();
      double before = 0;
      for(int iteration = 0; iteration < most_iterations; ++iteration)
      {
        cycle(0, residual, preconditioned);
        const double now = product(residual, preconditioned);
        const double share = iteration > 0 ? now / before : 0;
        before = now;
        for(unsigned int i = 0; i < n; ++i)
          direction.local_element(i)
              = preconditioned.local_element(i) + share * direction.local_element(i);
        multiply(direction, image);
        const double curvature = product(direction, image);
        if(!(curvature > 0))
          return;
        const double length = now / curvature;
        for(unsigned int i = 0; i < n; ++i)
        {
          x[i] += length * direction.local_element(i);
          residual.local_element(i) -= length * image.local_element(i);
        }
        ++linear_iterations;
        entries_touched
            += levels.front().conduction.entries() + passes_of_cycle * entries_of_levels;
        if(std::sqrt(product(residual, residual)) <= enough)
          return;
      }
    }
  } // namespace

  std::unique_ptr<LinearSolver> make_rank_solver(const std::vector<RankLevel> &levels,
                                                 Traffic &traffic)
  {
    return std::make_unique<RankSolver>(levels, traffic);
  }
} // namespace meltfront::reference_fem
