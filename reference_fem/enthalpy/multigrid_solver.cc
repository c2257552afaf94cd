#include <reference_fem/enthalpy/linear_solver.h>
#include <reference_fem/enthalpy/multigrid.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    double scalar_product(const std::vector<double> &x, const std::vector<double> &y)
    {
      // Four sums, since one waits for its own last addition.
      std::array<double, 4> sums{};
      std::size_t i = 0;
      for(; i + 4 <= x.size(); i += 4)
        for(std::size_t k = 0; k < 4; ++k)
          sums[k] += x[i + k] * y[i + k];
      for(; i < x.size(); ++i)
        sums[0] += x[i] * y[i];
      return (sums[0] + sums[1]) + (sums[2] + sums[3]);
    }

    /** Conjugate gradients for (D/c + K) x = r/c. */
    template <class Level>
    class MultigridSolver : public LinearSolver
    {
    public:
      MultigridSolver(const ConductionMatrix &conduction,
                      std::shared_ptr<const Levels> levels)
        : conduction(conduction)
        , all_levels(std::move(levels))
        , levels(std::get<std::vector<Level>>(*all_levels))
        , multigrid(this->levels, conduction)
        , residual(conduction.size())
        , preconditioned(conduction.size())
        , direction(conduction.size())
        , image(conduction.size())
      {
      }

      std::string description() const override
      {
        return "conjugate gradients, symmetric Gauss-Seidel or (from 2000 nodes and a "
               "Fourier "
               "number of 15, in space 40) truncated multigrid on lattices";
      }

      void conductances_changed() override
      {
        multigrid.take(conduction);
      }

      void solve(const NewtonSystem &system, double reduction,
                 std::vector<double> &x) override;

    private:
      bool levels_pay(const NewtonSystem &system) const;

      const ConductionMatrix &conduction;
      std::shared_ptr<const Levels> all_levels;
      const std::vector<Level> &levels;
      Multigrid<Level> multigrid;
      std::vector<double> residual, preconditioned, direction, image;
    };

    /** Sweeps alone need iterations as the root of the largest Fourier number. Where both
     * take the same time was measured on block-melting-2d and -3d. */
    template <class Level>
    bool MultigridSolver<Level>::levels_pay(const NewtonSystem &system) const
    {
      constexpr std::size_t few_nodes = 2000;
      const double long_step = levels.front().in_space() ? 40 : 15;
      if(conduction.size() < few_nodes)
        return false;
      for(std::size_t i = 0; i < conduction.size(); ++i)
        if(system.active[i]
           && system.step_factor * conduction.diagonal[i]
                  > long_step * system.heat_capacity[i])
          return true;
      return false;
    }

    template <class Level>
    void MultigridSolver<Level>::solve(const NewtonSystem &system, double reduction,
                                       std::vector<double> &x)
    {
      // Stopping early is safe: the outer iteration goes on until the graph holds.
      constexpr int most_iterations = 200;
      // Of a product and a cycle over all levels, and of setting them up; of a product
      // and a sweep there and back.
      constexpr long passes_of_levels = 7, passes_of_set_up = 5, passes_of_sweeps = 3;
      const double scale = 1 / system.step_factor;
      const std::size_t n = x.size();
      for(std::size_t i = 0; i < n; ++i)
        residual[i] = system.active[i] ? system.residual[i] * scale : 0;
      std::fill(x.begin(), x.end(), 0);
      const double start = std::sqrt(scalar_product(residual, residual));
      const double enough
          = std::max(reduction * start, system.sufficient_residual * scale);
      if(start <= enough)
        return;
      const bool with_levels = levels_pay(system);
      const long passes = with_levels ? passes_of_levels : passes_of_sweeps;
      multigrid.set_up(system.heat_capacity, scale, system.active, with_levels);
      entries_touched += (with_levels ? passes_of_set_up : 0) * conduction.entries();
      double before = 0;
      for(int iteration = 0; iteration < most_iterations; ++iteration)
      {
        multigrid.precondition(residual, preconditioned);
        const double now = scalar_product(residual, preconditioned);
        const double share = iteration > 0 ? now / before : 0;
        before = now;
        for(std::size_t i = 0; i < n; ++i)
          direction[i] = preconditioned[i] + share * direction[i];
        multigrid.multiply(direction, image);
        const double curvature = scalar_product(direction, image);
        if(!(curvature > 0))
          return;
        const double length = now / curvature;
        for(std::size_t i = 0; i < n; ++i)
        {
          x[i] += length * direction[i];
          residual[i] -= length * image[i];
        }
        ++linear_iterations;
        entries_touched += passes * conduction.entries();
        const double left = std::sqrt(scalar_product(residual, residual));
        if(left <= enough)
          return;
      }
    }
  } // namespace

  std::unique_ptr<LinearSolver>
  make_multigrid_solver(const ConductionMatrix &matrix,
                        const std::shared_ptr<const Levels> &levels)
  {
    return std::visit(
        [&]<class Level>(const std::vector<Level> &) -> std::unique_ptr<LinearSolver>
        { return std::make_unique<MultigridSolver<Level>>(matrix, levels); },
        *levels);
  }
} // namespace meltfront::reference_fem
