#include <reference_fem/enthalpy/distributed/rank_correction.h>
#include <reference_fem/enthalpy/distributed/rank_newton.h>
#include <reference_fem/enthalpy/distributed/shared_search.h>
#include <reference_fem/enthalpy/distributed/sharing_ranks.h>
#include <reference_fem/enthalpy/graph.h>
#include <reference_fem/enthalpy/step_newton.h>

#include <cmath>
#include <optional>

namespace meltfront::reference_fem
{
  namespace
  {
    /** @tparam with_exchange walls exchange heat with their surroundings */
    template <class Graph, bool with_exchange>
    class RankNewton : public NonlinearSolver,
                       private StepNewton<RankNewton<Graph, with_exchange>, SharingRanks>
    {
    public:
      RankNewton(const StepProblem &problem, const std::vector<RankLevel> &levels,
                 const cases::Material &material,
                 std::unique_ptr<LinearSolver> linear_solver, Traffic &traffic)
        : Base(problem, *linear_solver,
               SharingRanks(levels.front(), problem.conduction, traffic))
        , levels(levels)
        , graph(material)
        , owned_solver(std::move(linear_solver))
        , traffic(traffic)
      {
        direction.resize(levels.front().n_with_ghosts());
        if constexpr(Graph::jumps)
          cost.bytes = static_cast<long>(active.size() * sizeof(char));
      }

      StepOutcome solve(double c, const std::vector<double> &rhs, int iteration_limit,
                        CompensatedVector &u, std::vector<double> &heat) override
      {
        return this->iterate(c, rhs, iteration_limit, u, heat);
      }

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
        return entries_touched + owned_solver->work();
      }
      GraphCost graph_cost() const override
      {
        return cost;
      }

    private:
      using Base = StepNewton<RankNewton<Graph, with_exchange>, SharingRanks>;
      friend Base;
      using Base::active, Base::cost, Base::direction, Base::entries_touched,
          Base::heat_capacity, Base::n_own, Base::problem, Base::processes,
          Base::residual, Base::scale;

      static constexpr bool jumps = Graph::jumps;
      static constexpr bool exchanges = with_exchange;
      static constexpr bool moves_fronts = Graph::jumps;

      double excess(double u) const
      {
        return graph.temperature_excess(u);
      }

      double excess_at_enthalpy(std::size_t, double enthalpy) const
      {
        return graph.temperature_excess_at_enthalpy(enthalpy);
      }

      double latent_temperature() const
      {
        return graph.latent_temperature();
      }

      bool same_side(std::size_t, double u, double recovered) const
      {
        return (u > 0) == (recovered > 0) && (u < 0) == (recovered < 0);
      }

      bool has_coarser_meshes() const
      {
        return levels.size() > 1;
      }

      double transfer(std::size_t i, double c) const
      {
        if constexpr(exchanges)
          return c * problem.exchange->transfer[i];
        return 0;
      }

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
      void descend(double c, CompensatedVector &u, const std::vector<double> &heat);
      void descend_over_jumps(double c, CompensatedVector &u,
                              const std::vector<double> &heat);

      const std::vector<RankLevel> &levels;
      Graph graph;
      std::optional<RankCorrection<Graph>> coarse; ///< once a front has gone far
      std::unique_ptr<LinearSolver> owned_solver;
      Traffic &traffic;
    };

    /** Solve one node's inclusion; true if it moved on, off or over the jump. */
    template <class Graph, bool with_exchange>
    bool RankNewton<Graph, with_exchange>::relax(std::size_t i, double c,
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
    template <class Graph, bool with_exchange>
    double RankNewton<Graph, with_exchange>::linearise(double c,
                                                       const CompensatedVector &u,
                                                       const std::vector<double> &heat)
    {
      std::array<double, 2> sums{}; // of squares; of nodes
      for(std::size_t i = 0; i < n_own(); ++i)
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
      sums = processes.sum(sums);
      return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
    }

    /** As TruncatedNewton::add_slope_of_jump: L delta(u), a hat as wide as u changes from
     * a node to its neighbours. */
    template <class Graph, bool with_exchange>
    void
    RankNewton<Graph, with_exchange>::add_slope_of_jump(const CompensatedVector &u,
                                                        const std::vector<double> &heat)
    {
      const ConductionMatrix &conduction = problem.conduction;
      for(std::size_t i = 0; i < n_own(); ++i)
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
    template <class Graph, bool with_exchange>
    bool RankNewton<Graph, with_exchange>::project(const CompensatedVector &u)
    {
      bool cut = false;
      for(std::size_t i = 0; i < n_own(); ++i)
        if(active[i] && (u[i] + direction[i]) * u[i] < 0)
        {
          cut = true;
          if constexpr(Graph::jumps)
            direction[i] = -u[i];
        }
      return processes.anywhere(cut);
    }

    /** The length along the direction at which the functional is lowest. */
    template <class Graph, bool with_exchange>
    double RankNewton<Graph, with_exchange>::line_search(double c,
                                                         const CompensatedVector &u,
                                                         const std::vector<double> &heat)
    {
      processes.update(direction);
      KinkedDerivative derivative;
      for(std::size_t i = 0; i < n_own(); ++i)
        if(direction[i] != 0)
          derivative.add_node(graph, u[i], direction[i], problem.volume[i],
                              transfer(i, c), heat[i],
                              c * problem.conduction.product(i, direction));
      entries_touched += problem.conduction.entries();
      return lowest_of_all(derivative, levels.front().communicator, traffic);
    }

    /** Correct from coarser meshes: fronts move by as many cells as it takes. */
    template <class Graph, bool with_exchange>
    void
    RankNewton<Graph, with_exchange>::correct_coarsely(double c, CompensatedVector &u,
                                                       const std::vector<double> &heat)
    {
      if(!coarse)
        coarse.emplace(levels, problem.volume, graph, traffic);
      std::vector<double> &on_graph = residual;
      for(std::size_t i = 0; i < n_own(); ++i)
        on_graph[i] = graph.heat_on_graph(u[i], problem.volume[i], heat[i]);
      coarse->correct(c, on_graph, heat,
                      exchanges ? &problem.exchange->transfer : nullptr, direction);
      descend_over_jumps(c, u, heat);
      // The levels together take a third more than the finest one.
      constexpr long passes = 8;
      entries_touched += passes * problem.conduction.entries();
    }

    /** Go along the direction to the functional's minimum, over jumps as they come. */
    template <class Graph, bool with_exchange>
    void
    RankNewton<Graph, with_exchange>::descend_over_jumps(double c, CompensatedVector &u,
                                                         const std::vector<double> &heat)
    {
      const double length = line_search(c, u, heat);
      for(std::size_t i = 0; i < n_own(); ++i)
        u.add(i, length * direction[i]);
      processes.update(u);
    }

    /** Nodes stop at the jump. */
    template <class Graph, bool with_exchange>
    void RankNewton<Graph, with_exchange>::descend(double c, CompensatedVector &u,
                                                   const std::vector<double> &heat)
    {
      double length = 1;
      if(!Graph::linear && project(u))
        length = line_search(c, u, heat);
      for(std::size_t i = 0; i < n_own(); ++i)
        if(active[i])
        {
          const double change = length * direction[i];
          if(Graph::jumps && u[i] + change == 0)
            u.set(i, 0);
          else
            u.add(i, change);
        }
      processes.update(u);
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
