#ifndef meltfront_reference_fem_enthalpy_truncated_newton_templates_h
#define meltfront_reference_fem_enthalpy_truncated_newton_templates_h

#include <reference_fem/enthalpy/coarse_correction.h>
#include <reference_fem/enthalpy/graph.h>
#include <reference_fem/enthalpy/line_search.h>
#include <reference_fem/enthalpy/step_newton.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  /** What TruncatedNewton asks of the process that has the whole mesh, beside what
   * StepNewton does. */
  struct WholeMesh : OneProcess
  {
    bool has_coarser_meshes(const StepProblem &problem) const
    {
      return n_levels(problem.levels) > 1;
    }

    template <class Graph>
    std::unique_ptr<FrontMover> front_mover(const StepProblem &problem,
                                            const Graph &graph) const
    {
      return make_front_mover(problem, graph);
    }

    double lowest(KinkedDerivative &derivative) const
    {
      return derivative.lowest();
    }

    void add_up(double &, double &) const
    {
    }
  };

  /**
   * NonlinearSolver on the mesh of one process, or on its part of one that several share.
   *
   * @tparam with_exchange walls exchange heat with their surroundings
   * @tparam Processes as of StepNewton, and `has_coarser_meshes(problem)`;
   * `front_mover(problem, graph)`; `lowest(derivative)`, the length at which the sum of
   * all processes' functionals is lowest; `add_up(a, b)`, which takes their sums
   */
  template <class Graph, bool with_exchange, class Processes = WholeMesh>
  class TruncatedNewton
    : public NonlinearSolver,
      private StepNewton<TruncatedNewton<Graph, with_exchange, Processes>, Processes>
  {
  public:
    TruncatedNewton(const StepProblem &problem, const cases::Material &material,
                    std::unique_ptr<LinearSolver> linear_solver, Processes processes)
      : Base(problem, *linear_solver, std::move(processes))
      , graph(material)
      , owned_solver(std::move(linear_solver))
    {
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
    using Base = StepNewton<TruncatedNewton<Graph, with_exchange, Processes>, Processes>;
    friend Base;
    using Base::active, Base::cost, Base::direction, Base::entries_touched,
        Base::heat_capacity, Base::n_own, Base::problem, Base::processes, Base::residual,
        Base::scale;

    static constexpr bool jumps = Graph::jumps || Graph::curved;
    static constexpr bool exchanges = with_exchange;
    static constexpr bool moves_fronts = Graph::jumps && !Graph::curved;

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
      if constexpr(Graph::curved)
        return graph.region(excess(u)) == graph.region(recovered);
      else
        return (u > 0) == (recovered > 0) && (u < 0) == (recovered < 0);
    }

    bool has_coarser_meshes() const
    {
      return processes.has_coarser_meshes(problem);
    }

    /** Of the heat that walls take over a step, by Kirchhoff's variable. */
    double exchange_slope(std::size_t i, double c, double u) const
    {
      return c * problem.exchange->transfer[i] * graph.excess_slope(u);
    }

    bool relax(std::size_t i, double c, const std::vector<double> &rhs,
               CompensatedVector &u);
    double linearise(double c, const CompensatedVector &u,
                     const std::vector<double> &heat);
    void descend(double c, CompensatedVector &u, const std::vector<double> &heat);
    bool project(const CompensatedVector &u);
    double line_search(double c, const CompensatedVector &u);
    void add_slope_of_jump(const CompensatedVector &u, const std::vector<double> &heat);
    void descend_over_jumps(double c, CompensatedVector &u,
                            const std::vector<double> &heat);
    void correct_coarsely(double c, CompensatedVector &u,
                          const std::vector<double> &heat);
    double curved_line_search(double c, const CompensatedVector &u,
                              const std::vector<double> &heat);
    void advance(double length, CompensatedVector &u) const;

    Graph graph;
    std::unique_ptr<FrontMover> coarse; ///< once a front has gone far
    std::unique_ptr<LinearSolver> owned_solver;
  };

  /** Solve one node's inclusion; true if it moved on, off or over the jump. */
  template <class Graph, bool with_exchange, class Processes>
  bool TruncatedNewton<Graph, with_exchange, Processes>::relax(
      std::size_t i, double c, const std::vector<double> &rhs, CompensatedVector &u)
  {
    const double volume = problem.volume[i];
    const double stiffness = c * problem.conduction.diagonal[i];
    double supply = rhs[i] + c * problem.conduction.inflow(i, u);
    if constexpr(exchanges)
      supply += c * problem.exchange->supply[i];
    if(!Graph::curved && u[i] != 0)
    {
      // As an increment, which the compensated sum keeps exactly.
      double missing = supply - volume * graph.enthalpy(u[i]),
             slope = volume * graph.slope(u[i]) + stiffness;
      if constexpr(exchanges)
      {
        missing -= c * problem.exchange->transfer[i] * excess(u[i]);
        slope += exchange_slope(i, c, u[i]);
      }
      const double change = missing / slope;
      if((u[i] + change) * u[i] > 0)
      {
        u.add(i, change);
        return false;
      }
    }
    const double before = u[i];
    supply += stiffness * before;
    if constexpr(exchanges)
      u.set(i,
            graph.resolve(supply, volume, stiffness, c * problem.exchange->transfer[i]));
    else
      u.set(i, graph.resolve(supply, volume, stiffness));
    if constexpr(Graph::curved)
      return graph.region(excess(before)) != graph.region(excess(u[i]));
    else
      return before != 0 || u[i] != 0;
  }

  /** Fill heat_capacity, active and residual; returns the heat that changes a typical
   * active node by one kelvin. */
  template <class Graph, bool with_exchange, class Processes>
  double TruncatedNewton<Graph, with_exchange, Processes>::linearise(
      double c, const CompensatedVector &u, const std::vector<double> &heat)
  {
    double heat_per_kelvin = 0, nodes = 0;
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
      heat_capacity[i] = volume * graph.slope(u[i]);
      if constexpr(exchanges)
        heat_capacity[i] += exchange_slope(i, c, u[i]);
      residual[i] = heat[i] - volume * graph.enthalpy(u[i]);
      heat_per_kelvin += std::pow(volume * graph.capacity(u[i]), 2);
      ++nodes;
    }
    if constexpr(Graph::has_two_slopes)
      ++cost.linearisations;
    processes.add_up(heat_per_kelvin, nodes);
    return nodes > 0 ? std::sqrt(heat_per_kelvin / nodes) : 0;
  }

  /** Cut the direction off where it passes the jump; false where it never does. */
  template <class Graph, bool with_exchange, class Processes>
  bool
  TruncatedNewton<Graph, with_exchange, Processes>::project(const CompensatedVector &u)
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

  /**
   * The minimum over 0 <= length <= 1 of J(u + length d). Its derivative is continuous,
   * increasing and linear between the lengths at which a node changes phase.
   */
  template <class Graph, bool with_exchange, class Processes>
  double TruncatedNewton<Graph, with_exchange, Processes>::line_search(
      double c, const CompensatedVector &u)
  {
    KinkedDerivative derivative;
    processes.update(direction);
    for(std::size_t i = 0; i < n_own(); ++i)
    {
      const double d = direction[i];
      if(d == 0)
        continue;
      derivative.start -= residual[i] * d;
      derivative.slope
          += d * (heat_capacity[i] * d + c * problem.conduction.product(i, direction));
      if constexpr(!Graph::jumps)
      {
        const double length = -u[i] / d;
        if(!(length > 0 && length < 1))
          continue;
        double change = problem.volume[i] * (graph.slope(-u[i]) - graph.slope(u[i]));
        if constexpr(exchanges)
          change += exchange_slope(i, c, -u[i]) - exchange_slope(i, c, u[i]);
        derivative.kinks.push_back({length, 0, d * d * change});
      }
    }
    entries_touched += problem.conduction.entries();
    return processes.lowest(derivative);
  }

  /**
   * Add to the slopes of the nodes at fronts what the jump is worth there, L delta(u),
   * so that Newton's step knows that a front that moves takes latent heat: the delta
   * function is a hat as wide as u changes from a node to its neighbours (Engquist,
   * Tornberg and Tsai 2005).
   */
  template <class Graph, bool with_exchange, class Processes>
  void TruncatedNewton<Graph, with_exchange, Processes>::add_slope_of_jump(
      const CompensatedVector &u, const std::vector<double> &heat)
  {
    const ConductionMatrix &conduction = problem.conduction;
    const double jump = graph.enthalpy(0);
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
      heat_capacity[i] += volume * jump * (1 - size / width) / width;
    }
    entries_touched += conduction.entries();
  }

  /** Go along the direction to the functional's minimum, over jumps as they come. */
  template <class Graph, bool with_exchange, class Processes>
  void TruncatedNewton<Graph, with_exchange, Processes>::descend_over_jumps(
      double c, CompensatedVector &u, const std::vector<double> &heat)
  {
    KinkedDerivative derivative;
    processes.update(direction);
    for(std::size_t i = 0; i < n_own(); ++i)
    {
      if(direction[i] == 0)
        continue;
      double transfer = 0;
      if constexpr(exchanges)
        transfer = c * problem.exchange->transfer[i];
      derivative.add_node(graph, u[i], direction[i], problem.volume[i], transfer, heat[i],
                          c * problem.conduction.product(i, direction));
    }
    const double length = processes.lowest(derivative);
    for(std::size_t i = 0; i < n_own(); ++i)
      u.add(i, length * direction[i]);
    processes.update(u);
    entries_touched += problem.conduction.entries();
  }

  /** Correct from coarser lattices: fronts move by as many cells as it takes. */
  template <class Graph, bool with_exchange, class Processes>
  void TruncatedNewton<Graph, with_exchange, Processes>::correct_coarsely(
      double c, CompensatedVector &u, const std::vector<double> &heat)
  {
    if(!coarse)
      coarse = processes.front_mover(problem, graph);
    std::vector<double> &on_graph = residual;
    for(std::size_t i = 0; i < n_own(); ++i)
      on_graph[i] = graph.heat_on_graph(u[i], problem.volume[i], heat[i]);
    std::fill(direction.begin(), direction.end(), 0);
    coarse->correct(c, problem.free, on_graph, heat,
                    exchanges ? &problem.exchange->transfer : nullptr, direction);
    descend_over_jumps(c, u, heat);
    // The levels together take a third more than the finest one.
    constexpr long passes = 8;
    entries_touched += passes * problem.conduction.entries();
  }

  template <class Graph, bool with_exchange, class Processes>
  void
  TruncatedNewton<Graph, with_exchange, Processes>::advance(double length,
                                                            CompensatedVector &u) const
  {
    for(std::size_t i = 0; i < n_own(); ++i)
    {
      if(!active[i])
        continue;
      const double change = length * direction[i];
      if(Graph::jumps && u[i] + change == 0)
        u.set(i, 0);
      else
        u.add(i, change);
    }
    processes.update(u);
  }

  /** The same where the derivative is no broken line. */
  template <class Graph, bool with_exchange, class Processes>
  double TruncatedNewton<Graph, with_exchange, Processes>::curved_line_search(
      double c, const CompensatedVector &u, const std::vector<double> &heat)
  {
    double conducted = 0, start = 0;
    for(std::size_t i = 0; i < n_own(); ++i)
      if(direction[i] != 0)
      {
        conducted += c * direction[i] * problem.conduction.product(i, direction);
        start -= direction[i] * residual[i];
      }
    entries_touched += problem.conduction.entries();
    const auto fall = [&](double length)
    {
      double derivative = length * conducted;
      for(std::size_t i = 0; i < n_own(); ++i)
      {
        const double d = direction[i];
        if(d == 0)
          continue;
        const double there = u[i] + length * d;
        // On the jump, the end that the direction comes from.
        double rise = Graph::jumps && there == 0 && d > 0 ? 0 : graph.enthalpy(there);
        rise = problem.volume[i] * rise - heat[i];
        if constexpr(exchanges)
          rise += c * problem.exchange->transfer[i] * (excess(there) - excess(u[i]));
        derivative += d * rise;
      }
      return derivative;
    };
    return nearly_lowest(start, fall);
  }

  template <class Graph, bool with_exchange, class Processes>
  void TruncatedNewton<Graph, with_exchange, Processes>::descend(
      double c, CompensatedVector &u, [[maybe_unused]] const std::vector<double> &heat)
  {
    double length = 1;
    if constexpr(Graph::curved)
    {
      project(u);
      length = curved_line_search(c, u, heat);
    }
    else if constexpr(!Graph::linear)
      if(project(u))
        length = line_search(c, u);
    advance(length, u);
  }

  template <class Graph, class Processes>
  std::unique_ptr<NonlinearSolver>
  make_truncated_newton(const StepProblem &problem, const cases::Material &material,
                        std::unique_ptr<LinearSolver> linear_solver, Processes processes)
  {
    if(problem.exchange)
      return std::make_unique<TruncatedNewton<Graph, true, Processes>>(
          problem, material, std::move(linear_solver), std::move(processes));
    return std::make_unique<TruncatedNewton<Graph, false, Processes>>(
        problem, material, std::move(linear_solver), std::move(processes));
  }

  /** The solver for the graph that the effects compose, one of lines. */
  template <class Processes>
  std::unique_ptr<NonlinearSolver>
  make_truncated_newton(const StepProblem &problem, const cases::Material &material,
                        const cases::EffectSet &effects,
                        std::unique_ptr<LinearSolver> linear_solver, Processes processes)
  {
    using cases::Effect;
    // An effect that is on with nothing to act on composes the simpler graph.
    const bool latent
        = effects.contains(Effect::phase_change) && material.latent_heat > 0;
    const bool two_slopes
        = ((effects.contains(Effect::phase_conductivity)
            || effects.contains(Effect::liquid_motion))
           && material.solid.conductivity != material.liquid.conductivity)
          || (effects.contains(Effect::phase_heat_capacity)
              && material.solid.specific_heat_capacity
                     != material.liquid.specific_heat_capacity);
    const auto of = [&]<bool jumps, bool bends>()
    {
      return make_truncated_newton<EnthalpyGraph<jumps, bends>>(
          problem, material, std::move(linear_solver), std::move(processes));
    };
    if(latent)
      return two_slopes ? of.template operator()<true, true>()
                        : of.template operator()<true, false>();
    return two_slopes ? of.template operator()<false, true>()
                      : of.template operator()<false, false>();
  }
} // namespace meltfront::reference_fem

#endif
