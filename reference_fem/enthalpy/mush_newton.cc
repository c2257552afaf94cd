#include <reference_fem/enthalpy/line_search.h>
#include <reference_fem/enthalpy/mush_newton.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    double square(double x)
    {
      return x * x;
    }
  } // namespace

  template <bool with_exchange>
  MushNewton<with_exchange>::MushNewton(const StepProblem &problem,
                                        const MushGraph &graph,
                                        const std::vector<Composition> &composition,
                                        LinearSolver &linear_solver)
    : Base(problem, linear_solver)
    , graph(graph)
    , composition(composition)
  {
    cost.bytes = static_cast<long>(active.size() * sizeof(char));
  }

  /** Solve one node's inclusion; true if it moved to another region of its graph. */
  template <bool with_exchange>
  bool MushNewton<with_exchange>::relax(std::size_t i, double c,
                                        const std::vector<double> &rhs,
                                        CompensatedVector &u)
  {
    double stiffness = c * problem.conduction.diagonal[i];
    const double before = u[i];
    double supply = rhs[i] + c * problem.conduction.inflow(i, u) + stiffness * before;
    if constexpr(exchanges)
    {
      supply += c * problem.exchange->supply[i];
      stiffness += c * problem.exchange->transfer[i];
    }
    u.set(i, graph.resolve(supply, problem.volume[i], stiffness, composition[i]));
    return graph.region(u[i], composition[i]) != graph.region(before, composition[i]);
  }

  /** Fill heat_capacity, active and residual; returns the heat that changes a typical
   * active node by one kelvin. */
  template <bool with_exchange>
  double MushNewton<with_exchange>::linearise(double c, const CompensatedVector &u,
                                              const std::vector<double> &heat)
  {
    double heat_per_kelvin = 0;
    long nodes = 0;
    for(std::size_t i = 0; i < u.size(); ++i)
    {
      if(!problem.free[i])
        continue;
      active[i] = graph.region(u[i], composition[i]) != MushRegion::held;
      residual[i] = 0;
      if(!active[i])
        continue;
      const double volume = problem.volume[i];
      heat_capacity[i] = volume * graph.slope(u[i], composition[i]);
      if constexpr(exchanges)
        heat_capacity[i] += c * problem.exchange->transfer[i];
      residual[i] = heat[i] - volume * graph.enthalpy(u[i], composition[i]);
      heat_per_kelvin += square(heat_capacity[i]);
      ++nodes;
    }
    ++cost.linearisations;
    return nodes > 0 ? std::sqrt(heat_per_kelvin / nodes) : 0;
  }

  /** Cut the direction off where it passes a jump. */
  template <bool with_exchange>
  void MushNewton<with_exchange>::project(const CompensatedVector &u)
  {
    for(std::size_t i = 0; i < u.size(); ++i)
    {
      const double step = graph.jump(composition[i]);
      if(active[i] && (u[i] - step) * (u[i] + direction[i] - step) < 0)
        direction[i] = step - u[i];
    }
  }

  /** Where a share of the direction leads: onto a jump where it ends there but for
   * round-off. */
  template <bool with_exchange>
  double MushNewton<with_exchange>::moved(std::size_t i, double length,
                                          const CompensatedVector &u) const
  {
    constexpr double round_off = 4e-16;
    const double step = graph.jump(composition[i]), there = u[i] + length * direction[i];
    return std::abs(there - step) < round_off * std::abs(step) ? step : there;
  }

  /** The functional's derivative along the direction, at a share of its length. */
  template <bool with_exchange>
  double MushNewton<with_exchange>::fall(double length, double conducted,
                                         const CompensatedVector &u,
                                         const std::vector<double> &heat) const
  {
    double derivative = length * conducted;
    for(std::size_t i = 0; i < u.size(); ++i)
    {
      const double d = direction[i];
      if(d == 0)
        continue;
      // On a jump, the end that the direction comes from.
      const double there = moved(i, length, u);
      const bool from_below
          = d > 0 && graph.region(there, composition[i]) == MushRegion::held;
      const double enthalpy = from_below ? graph.lower_enthalpy(there)
                                         : graph.enthalpy(there, composition[i]);
      derivative += d * (problem.volume[i] * enthalpy - heat[i]);
    }
    return derivative;
  }

  /** The share of the direction to go: see nearly_lowest(). */
  template <bool with_exchange>
  double MushNewton<with_exchange>::line_search(double c, const CompensatedVector &u,
                                                const std::vector<double> &heat)
  {
    double conducted = 0, start = 0;
    for(std::size_t i = 0; i < u.size(); ++i)
      if(direction[i] != 0)
      {
        conducted += c * direction[i] * problem.conduction.product(i, direction);
        if constexpr(exchanges)
          conducted += c * problem.exchange->transfer[i] * square(direction[i]);
        start -= direction[i] * residual[i];
      }
    entries_touched += problem.conduction.entries();
    return nearly_lowest(start,
                         [&](double length) { return fall(length, conducted, u, heat); });
  }

  template <bool with_exchange>
  void MushNewton<with_exchange>::advance(double length, CompensatedVector &u) const
  {
    for(std::size_t i = 0; i < u.size(); ++i)
    {
      if(!active[i])
        continue;
      const double there = moved(i, length, u);
      if(there == graph.jump(composition[i]))
        u.set(i, there);
      else
        u.add(i, length * direction[i]);
    }
  }

  template <bool with_exchange>
  void MushNewton<with_exchange>::descend(double c, CompensatedVector &u,
                                          const std::vector<double> &heat)
  {
    project(u);
    advance(line_search(c, u, heat), u);
  }

  std::unique_ptr<MushSolver>
  make_mush_solver(const StepProblem &problem, const MushGraph &graph,
                   const std::vector<Composition> &composition,
                   LinearSolver &linear_solver)
  {
    if(problem.exchange)
      return std::make_unique<MushNewton<true>>(problem, graph, composition,
                                                linear_solver);
    return std::make_unique<MushNewton<false>>(problem, graph, composition,
                                               linear_solver);
  }
} // namespace meltfront::reference_fem
