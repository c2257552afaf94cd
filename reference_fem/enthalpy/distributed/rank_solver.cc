#include <reference_fem/enthalpy/distributed/rank_multigrid.h>
#include <reference_fem/enthalpy/distributed/rank_solver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    class RankSolver : public LinearSolver
    {
    public:
      RankSolver(const std::vector<RankLevel> &levels, Traffic &traffic)
        : communicator(levels.front().communicator)
        , n(levels.front().n_own())
        , traffic(traffic)
        , multigrid(levels, traffic)
        , residual(n)
        , image(n)
        , preconditioned(levels.front().n_with_ghosts())
        , search(levels.front().n_with_ghosts())
        , entries(levels.front().conduction.n_entries())
      {
      }

      std::string description() const override
      {
        return "conjugate gradients, geometric multigrid with truncation, Gauss-Seidel "
               "on each rank";
      }

      void solve(const NewtonSystem &system, double reduction,
                 std::vector<double> &x) override;

    private:
      template <typename Term>
      double sum_over_nodes(const Term &term);

      MPI_Comm communicator;
      std::size_t n; ///< own nodes
      Traffic &traffic;
      RankMultigrid multigrid;
      std::vector<double> residual, image;
      std::vector<double> preconditioned, search; ///< with ghosts
      long entries;
    };

    /** Of all ranks, of a term by own node. */
    template <typename Term>
    double RankSolver::sum_over_nodes(const Term &term)
    {
      // Four sums, since one waits for its own last addition.
      std::array<double, 4> sums{};
      std::size_t i = 0;
      for(; i + 4 <= n; i += 4)
        for(std::size_t k = 0; k < 4; ++k)
          sums[k] += term(i + k);
      for(; i < n; ++i)
        sums[0] += term(i);
      ++traffic.reductions;
      return dealii::Utilities::MPI::sum((sums[0] + sums[1]) + (sums[2] + sums[3]),
                                         communicator);
    }

    void RankSolver::solve(const NewtonSystem &system, double reduction,
                           std::vector<double> &solution)
    {
      // Stopping early is safe: the outer iteration goes on until the graph holds.
      constexpr int most_iterations = 200;
      // Of a product; of a cycle over all levels.
      constexpr long passes_of_cycle = 4;
      const double scale = 1 / system.step_factor;
      double *const x = solution.data(), *const r = residual.data(),
                    *const d = search.data(), *const a_d = image.data();
      const double *const z = preconditioned.data();
      std::fill(solution.begin(), solution.end(), 0);
      const double start = std::sqrt(sum_over_nodes(
          [&](std::size_t i)
          {
            r[i] = system.active[i] ? system.residual[i] * scale : 0;
            return r[i] * r[i];
          }));
      const double enough
          = std::max(reduction * start, system.sufficient_residual * scale);
      if(start <= enough)
        return;
      multigrid.set_up(system, scale);
      double before = 0;
      for(int iteration = 0; iteration < most_iterations; ++iteration)
      {
        multigrid.precondition(residual, preconditioned);
        const double now = sum_over_nodes([=](std::size_t i) { return r[i] * z[i]; });
        const double share = iteration > 0 ? now / before : 0;
        before = now;
        for(std::size_t i = 0; i < n; ++i)
          d[i] = z[i] + share * d[i];
        multigrid.multiply(search, image);
        const double curvature
            = sum_over_nodes([=](std::size_t i) { return d[i] * a_d[i]; });
        if(!(curvature > 0))
          return;
        const double length = now / curvature;
        const double left = std::sqrt(sum_over_nodes(
            [=](std::size_t i)
            {
              x[i] += length * d[i];
              r[i] -= length * a_d[i];
              return r[i] * r[i];
            }));
        ++linear_iterations;
        entries_touched += entries + passes_of_cycle * multigrid.entries();
        if(left <= enough)
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
