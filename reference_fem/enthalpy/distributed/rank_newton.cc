#include <reference_fem/enthalpy/distributed/ghosts.h>
#include <reference_fem/enthalpy/distributed/rank_correction.h>
#include <reference_fem/enthalpy/distributed/rank_newton.h>
#include <reference_fem/enthalpy/distributed/shared_search.h>
#include <reference_fem/enthalpy/graph.h>

#include <cases/stopwatch.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::reference_fem
{
  namespace
  {
    /** @tparam exchanges walls exchange heat with their surroundings */
    template <class Graph, bool exchanges>
    class RankNewton : public NonlinearSolver
    {
    public:
      RankNewton(const StepProblem &problem, const std::vector<RankLevel> &levels,
                 const cases::Material &material,
                 std::unique_ptr<LinearSolver> linear_solver, Traffic &traffic)
        : problem(problem)
        , levels(levels)
        , communicator(levels.front().communicator())
        , n(levels.front().n_own())
        , graph(material)
        , linear_solver(std::move(linear_solver))
        , traffic(traffic)
        , ghosts(levels.front(), traffic)
        , active(problem.free)
        , heat_capacity(n)
        , residual(n)
        , direction(levels.front().n_with_ghosts())
      {
        if constexpr(Graph::jumps)
          cost.bytes = static_cast<long>(active.size() * sizeof(char));
      }

      StepOutcome solve(double c, const std::vector<double> &rhs, int iteration_limit,
                        CompensatedVector &u, std::vector<double> &heat) override;

      double temperature_excess(double u) const override
      {
        return graph.temperature_excess(u);
      }
      double kirchhoff_at_enthalpy(std::size_t, double enthalpy) const override
      {
        return graph.kirchhoff(graph.temperature_excess_at_enthalpy(enthalpy));
      }
      double kirchhoff(double temperature_excess) const override
      {
        return graph.kirchhoff(temperature_excess);
      }
      double temperature_scale() const override
      {
        return scale;
      }
      void set_temperature_scale(double of_steps_before) override
      {
        scale = of_steps_before;
      }
      long work() const override
      {
        return entries_touched + linear_solver->work();
      }
      GraphCost graph_cost() const override
      {
        return cost;
      }

    private:
      /** The share of rho L/(rho c) below which temperatures drown in its round-off. */
      static constexpr double round_off_share = 1e-3;

      struct Consistency
      {
        double distance; ///< max |T(u) - T(H)| over the scale
        double scale;    ///< see StepOutcome::graph_inconsistency
        bool settled;    ///< every node is in the region of its heat
      };

      void recover_heat(double c, const std::vector<double> &rhs,
                        const CompensatedVector &u, std::vector<double> &heat);
      Consistency compare(const CompensatedVector &u, const std::vector<double> &heat);
      void sweep_while_moving(double c, const std::vector<double> &rhs,
                              CompensatedVector &u);
      bool relax(std::size_t i, double c, const std::vector<double> &rhs,
                 CompensatedVector &u) const;
      double linearise(double c, const CompensatedVector &u,
                       const std::vector<double> &heat);
      void add_slope_of_jump(const CompensatedVector &u, const std::vector<double> &heat);
      bool project(const CompensatedVector &u);
      double line_search(double c, const CompensatedVector &u,
                         const std::vector<double> &heat);
      void correct_coarsely(double c, CompensatedVector &u,
                            const std::vector<double> &heat);
      void descend(double c, CompensatedVector &u, const std::vector<double> &heat,
                   bool over_jumps);

      double transfer(std::size_t i, double c) const
      {
        if constexpr(exchanges)
          return c * problem.exchange->transfer[i];
        return 0;
      }

      bool anywhere(bool here)
      {
        ++traffic.reductions;
        return dealii::Utilities::MPI::max(here ? 1 : 0, communicator) > 0;
      }

      StepProblem problem;
      const std::vector<RankLevel> &levels;
      MPI_Comm communicator;
      std::size_t n; ///< own nodes
      Graph graph;
      std::optional<RankCorrection<Graph>> coarse; ///< once a front has gone far
      std::unique_ptr<LinearSolver> linear_solver;
      Traffic &traffic;
      Ghosts ghosts;
      std::vector<char> active;
      std::vector<double> heat_capacity, residual;
      std::vector<double> direction; ///< with ghosts
      double scale = 0;              ///< largest |T - T_m| of the steps solved so far
      long entries_touched = 0;
      GraphCost cost;
    };

    template <class Graph, bool exchanges>
    StepOutcome
    RankNewton<Graph, exchanges>::solve(double c, const std::vector<double> &rhs,
                                        int iteration_limit, CompensatedVector &u,
                                        std::vector<double> &heat)
    {
      constexpr double loose = 1e-3, tight = 1e-12, safety = 0.1;
      // A front within a cell or two of its place gets there by itself, and exactly.
      constexpr int by_itself = 2;
      StepOutcome outcome;
      ghosts.update(u);
      for(;; ++outcome.iterations)
      {
        if constexpr(exchanges)
          problem.exchange->follow([&](std::size_t i)
                                   { return graph.temperature_excess(u[i]); });
        recover_heat(c, rhs, u, heat);
        const Consistency state = compare(u, heat);
        outcome.graph_inconsistency = state.distance;
        outcome.converged = state.distance <= target_inconsistency;
        if(outcome.converged)
          scale = state.scale;
        if(outcome.converged || outcome.iterations == iteration_limit
           || !std::isfinite(state.distance))
          break;
        if constexpr(Graph::jumps)
          if(!state.settled)
          {
            const cases::ScopedTimer timer(cost.seconds);
            sweep_while_moving(c, rhs, u);
            recover_heat(c, rhs, u, heat);
            if(levels.size() > 1 && outcome.iterations >= by_itself)
            {
              correct_coarsely(c, u, heat);
              sweep_while_moving(c, rhs, u);
              recover_heat(c, rhs, u, heat);
            }
          }
        const bool front_moves = Graph::jumps && !state.settled
                                 && outcome.iterations >= by_itself
                                 && (outcome.iterations - by_itself) % 2 == 0;
        const double heat_per_kelvin = linearise(c, u, heat);
        if(front_moves)
          add_slope_of_jump(u, heat);
        linear_solver->solve(
            {heat_capacity, c, active, residual,
             safety * target_inconsistency * state.scale * heat_per_kelvin},
            state.settled ? tight : loose, direction);
        descend(c, u, heat, front_moves);
      }
      if(!outcome.converged)
        outcome.converged = outcome.graph_inconsistency <= accepted_inconsistency;
      return outcome;
    }

    template <class Graph, bool exchanges>
    void RankNewton<Graph, exchanges>::recover_heat(double c,
                                                    const std::vector<double> &rhs,
                                                    const CompensatedVector &u,
                                                    std::vector<double> &heat)
    {
      for(std::size_t i = 0; i < n; ++i)
        if(problem.free[i])
          heat[i]
              = static_cast<double>(rhs[i] + c * problem.conduction.exact_inflow(i, u));
      if constexpr(exchanges)
        problem.exchange->visit(
            [&](std::size_t i)
            {
              heat[i] += c * problem.exchange->supply[i]
                         - transfer(i, c) * graph.temperature_excess(u[i]);
            });
      entries_touched += problem.conduction.entries();
    }

    template <class Graph, bool exchanges>
    typename RankNewton<Graph, exchanges>::Consistency
    RankNewton<Graph, exchanges>::compare(const CompensatedVector &u,
                                          const std::vector<double> &heat)
    {
      double distance = 0, largest = 0;
      bool settled = true, finite = true;
      for(std::size_t i = 0; i < n; ++i)
      {
        const double excess = graph.temperature_excess(u[i]);
        largest = std::max(largest, std::abs(excess));
        if(!problem.free[i])
          continue;
        const double recovered
            = graph.temperature_excess_at_enthalpy(heat[i] / problem.volume[i]);
        const double off = std::abs(excess - recovered);
        finite = finite && std::isfinite(off);
        distance = std::max(distance, off);
        settled
            = settled && (u[i] > 0) == (recovered > 0) && (u[i] < 0) == (recovered < 0);
      }
      const std::vector<double> here{distance, largest, settled ? 0. : 1.,
                                     finite ? 0. : 1.};
      std::vector<double> most(here.size());
      dealii::Utilities::MPI::max(here, communicator, most);
      ++traffic.reductions;
      largest = std::max({most[1], scale, round_off_share * graph.latent_temperature()});
      if(most[3] > 0)
        return {std::nan(""), largest, false};
      return {largest > 0 ? most[0] / largest : most[0], largest, most[2] == 0};
    }

    template <class Graph, bool exchanges>
    void RankNewton<Graph, exchanges>::sweep_while_moving(double c,
                                                          const std::vector<double> &rhs,
                                                          CompensatedVector &u)
    {
      constexpr int most_sweeps = 4;
      for(int sweep = 0; sweep < most_sweeps; ++sweep)
      {
        bool moved = false;
        for(std::size_t i = 0; i < n; ++i)
          if(problem.free[i])
            moved = relax(i, c, rhs, u) || moved;
        ghosts.update(u);
        for(std::size_t i = n; i-- > 0;)
          if(problem.free[i])
            moved = relax(i, c, rhs, u) || moved;
        ghosts.update(u);
        entries_touched += 2 * problem.conduction.entries();
        ++cost.sweeps;
        if(!anywhere(moved))
          break;
      }
    }

    /** Solve one node's inclusion; true if it moved on, off or over the jump. */
    template <class Graph, bool exchanges>
    bool RankNewton<Graph, exchanges>::relax(std::size_t i, double c,
                                             const std::vector<double> &rhs,
                                             CompensatedVector &u) const
    {
      const double volume = problem.volume[i];
      const double stiffness = c * problem.conduction.diagonal[i];
      double supply = rhs[i] + c * problem.conduction.inflow(i, u);
      if constexpr(exchanges)
        supply += c * problem.exchange->supply[i];
      if(u[i] != 0)
      {
        // As an increment, which the compensated sum keeps exactly.
        const double missing = supply - volume * graph.enthalpy(u[i])
                               - transfer(i, c) * graph.temperature_excess(u[i]);
        const double change = missing
                              / (volume * graph.slope(u[i]) + stiffness
                                 + transfer(i, c) * graph.excess_slope(u[i]));
        if((u[i] + change) * u[i] > 0)
        {
          u.add(i, change);
          return false;
        }
      }
      const double before = u[i];
      u.set(i, graph.resolve(supply + stiffness * before, volume, stiffness,
                             transfer(i, c)));
      return before != 0 || u[i] != 0;
    }

    /** Fill heat_capacity, active and residual; returns the heat that changes a typical
     * active node by one kelvin. */
    template <class Graph, bool exchanges>
    double RankNewton<Graph, exchanges>::linearise(double c, const CompensatedVector &u,
                                                   const std::vector<double> &heat)
    {
      std::vector<double> sums(2); // of squares; of nodes
      for(std::size_t i = 0; i < n; ++i)
      {
        if(!problem.free[i])
          continue;
        if constexpr(Graph::jumps)
        {
          active[i] = u[i] != 0;
          if(!active[i])
          {
            residual[i] = 0;
            continue;
          }
        }
        const double volume = problem.volume[i];
        heat_capacity[i]
            = volume * graph.slope(u[i]) + transfer(i, c) * graph.excess_slope(u[i]);
        residual[i] = heat[i] - volume * graph.enthalpy(u[i]);
        sums[0] += std::pow(volume * graph.capacity(u[i]), 2);
        sums[1] += 1;
      }
      if constexpr(Graph::has_two_slopes)
        ++cost.linearisations;
      dealii::Utilities::MPI::sum(sums, communicator, sums);
      ++traffic.reductions;
      return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
    }

    /** As TruncatedNewton::add_slope_of_jump: L delta(u), a hat as wide as u changes from
     * a node to its neighbours. */
    template <class Graph, bool exchanges>
    void RankNewton<Graph, exchanges>::add_slope_of_jump(const CompensatedVector &u,
                                                         const std::vector<double> &heat)
    {
      const ConductionMatrix &conduction = problem.conduction;
      for(std::size_t i = 0; i < n; ++i)
      {
        if(!problem.free[i])
          continue;
        double width = 0;
        for(std::size_t k = conduction.row_start[i]; k < conduction.row_start[i + 1]; ++k)
          width += std::abs(u[conduction.column[k]] - u[i]) / 2;
        const double size = std::abs(u[i]);
        if(size >= width)
          continue;
        const double volume = problem.volume[i];
        if(!active[i])
        {
          active[i] = 1;
          heat_capacity[i] = 0;
          residual[i] = heat[i] - graph.heat_on_graph(u[i], volume, heat[i]);
        }
        heat_capacity[i] += volume * graph.enthalpy(0) * (1 - size / width) / width;
      }
      entries_touched += conduction.entries();
    }

    /** Cut the direction off where it passes the jump; false where it never does. */
    template <class Graph, bool exchanges>
    bool RankNewton<Graph, exchanges>::project(const CompensatedVector &u)
    {
      bool cut = false;
      for(std::size_t i = 0; i < n; ++i)
        if(active[i] && (u[i] + direction[i]) * u[i] < 0)
        {
          cut = true;
          if constexpr(Graph::jumps)
            direction[i] = -u[i];
        }
      return anywhere(cut);
    }

    /** The length along the direction at which the functional is lowest. */
    template <class Graph, bool exchanges>
    double RankNewton<Graph, exchanges>::line_search(double c, const CompensatedVector &u,
                                                     const std::vector<double> &heat)
    {
      ghosts.update(direction);
      KinkedDerivative derivative;
      for(std::size_t i = 0; i < n; ++i)
        if(direction[i] != 0)
          derivative.add_node(graph, u[i], direction[i], problem.volume[i],
                              transfer(i, c), heat[i],
                              c * problem.conduction.product(i, direction));
      entries_touched += problem.conduction.entries();
      return lowest_of_all(derivative, communicator, traffic);
    }

    /** Correct from coarser meshes: fronts move by as many cells as it takes. */
    template <class Graph, bool exchanges>
    void RankNewton<Graph, exchanges>::correct_coarsely(double c, CompensatedVector &u,
                                                        const std::vector<double> &heat)
    {
      if(!coarse)
        coarse.emplace(levels, problem.volume, graph, traffic);
      std::vector<double> &on_graph = residual;
      for(std::size_t i = 0; i < n; ++i)
        on_graph[i] = graph.heat_on_graph(u[i], problem.volume[i], heat[i]);
      coarse->correct(c, on_graph, heat,
                      exchanges ? &problem.exchange->transfer : nullptr, direction);
      const double length = line_search(c, u, heat);
      for(std::size_t i = 0; i < n; ++i)
        u.add(i, length * direction[i]);
      ghosts.update(u);
      // The levels together take a third more than the finest one.
      constexpr long passes = 8;
      entries_touched += passes * problem.conduction.entries();
    }

    /** @param over_jumps else nodes stop at the jump */
    template <class Graph, bool exchanges>
    void RankNewton<Graph, exchanges>::descend(double c, CompensatedVector &u,
                                               const std::vector<double> &heat,
                                               bool over_jumps)
    {
      double length = 1;
      if(over_jumps || (!Graph::linear && project(u)))
        length = line_search(c, u, heat);
      for(std::size_t i = 0; i < n; ++i)
        if(active[i])
        {
          const double change = length * direction[i];
          if(Graph::jumps && u[i] + change == 0)
            u.set(i, 0);
          else
            u.add(i, change);
        }
      ghosts.update(u);
    }

    template <class Graph>
    std::unique_ptr<NonlinearSolver>
    make(const StepProblem &problem, const std::vector<RankLevel> &levels,
         const cases::Material &material, std::unique_ptr<LinearSolver> linear_solver,
         Traffic &traffic)
    {
      if(problem.exchange)
        return std::make_unique<RankNewton<Graph, true>>(
            problem, levels, material, std::move(linear_solver), traffic);
      return std::make_unique<RankNewton<Graph, false>>(
          problem, levels, material, std::move(linear_solver), traffic);
    }
  } // namespace

  std::unique_ptr<NonlinearSolver>
  make_rank_newton(const StepProblem &problem, const std::vector<RankLevel> &levels,
                   const cases::Material &material, const cases::EffectSet &effects,
                   std::unique_ptr<LinearSolver> linear_solver, Traffic &traffic)
  {
    using cases::Effect;
    const cases::PhaseProperties &solid = material.solid, &liquid = material.liquid;
    // An effect that is on with nothing to act on composes the simpler graph.
    const bool latent
        = effects.contains(Effect::phase_change) && material.latent_heat > 0;
    const bool two_slopes
        = (effects.contains(Effect::phase_conductivity)
           && solid.conductivity != liquid.conductivity)
          || (effects.contains(Effect::phase_heat_capacity)
              && solid.specific_heat_capacity != liquid.specific_heat_capacity);
    const auto of = [&]<bool jumps, bool bends>()
    {
      return make<EnthalpyGraph<jumps, bends>>(problem, levels, material,
                                               std::move(linear_solver), traffic);
    };
    if(latent)
      return two_slopes ? of.template operator()<true, true>()
                        : of.template operator()<true, false>();
    return two_slopes ? of.template operator()<false, true>()
                      : of.template operator()<false, false>();
  }
} // namespace meltfront::reference_fem
