#ifndef meltfront_reference_fem_enthalpy_distributed_rank_correction_h
#define meltfront_reference_fem_enthalpy_distributed_rank_correction_h

#include <reference_fem/enthalpy/coarse_correction.h>
#include <reference_fem/enthalpy/distributed/rank_level.h>
#include <reference_fem/enthalpy/distributed/shared_search.h>

#include <algorithm>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * CoarseCorrection on several ranks: the full approximation scheme (Brandt 1977) on the
   * coarser meshes of the hierarchy, which moves a front by many cells at once. Other
   * than there, a coarse mesh conducts by its own cells, corrections vanish at the nodes
   * of walls that prescribe temperatures, and nodes of other ranks stand still in a
   * sweep.
   *
   * On coarse levels heats are over c, the factor of the step.
   */
  template <class Graph>
  class RankCorrection : public FrontMover
  {
  public:
    RankCorrection(const std::vector<RankLevel> &levels,
                   const std::vector<double> &volume, const Graph &graph,
                   Traffic &traffic)
      : levels(levels)
      , graph(graph)
      , traffic(traffic)
      , states(levels.size())
    {
      for(std::size_t l = 0; l < levels.size(); ++l)
        for(std::vector<double> *field :
            {&states[l].volume, &states[l].transfer, &states[l].u, &states[l].start,
             &states[l].right_side, &states[l].heat, &states[l].work})
          if(l > 0 || field == &states[l].heat || field == &states[l].work)
            field->resize(levels[l].n_with_ghosts());
      const Traffic of_steps = traffic; // which setting up, once a process, is no part of
      take(volume, states[0].work);
      for(std::size_t l = 1; l < levels.size(); ++l)
        restrict_to(l, l == 1 ? states[0].work : states[l - 1].volume, states[l].volume);
      traffic = of_steps;
    }

    /** Of the own nodes. */
    void correct(double c, const std::vector<char> &, const std::vector<double> &on_graph,
                 const std::vector<double> &heat, const std::vector<double> *transfer,
                 std::vector<double> &correction) override
    {
      factor = c;
      State &finest = states.front();
      if(transfer)
        for(std::size_t l = 1; l < levels.size(); ++l)
        {
          if(l == 1)
            take(*transfer, finest.work);
          restrict_to(l, l == 1 ? finest.work : states[l - 1].transfer,
                      states[l].transfer);
        }
      take(on_graph, finest.work);
      take(heat, finest.heat);
      solve_below(0, finest.work, finest.heat, 1 / c);
      interpolate(0, [&](std::size_t i, double change) { correction[i] += change; });
    }

  private:
    struct State
    {
      std::vector<double> volume, transfer, u, start, right_side, heat, work;
    };

    /** To own nodes that are free; zero at the others. */
    void take(const std::vector<double> &values, std::vector<double> &result) const
    {
      for(std::size_t i = 0; i < levels.front().n_own(); ++i)
        result[i] = levels.front().free[i] ? values[i] : 0;
    }

    void exchange(std::size_t l, std::vector<double> &values)
    {
      levels[l].exchange(values, traffic);
    }

    /** result = P' values, to level l. */
    void restrict_to(std::size_t l, std::vector<double> &values,
                     std::vector<double> &result)
    {
      exchange(l - 1, values);
      levels[l].from_finer.multiply(values.data(), [&](std::size_t i, double sum)
                                    { result[i] = levels[l].free[i] ? sum : 0; });
    }

    /** use(i, P (v - u_c)_i), from the level below l. */
    template <typename Use>
    void interpolate(std::size_t l, const Use &use)
    {
      exchange(l + 1, states[l + 1].start);
      levels[l + 1].to_finer.multiply(states[l + 1].start.data(),
                                      [&](std::size_t i, double sum)
                                      { use(i, levels[l].free[i] ? sum : 0); });
    }

    /** use(i, -(K u)_i) of a level; ghosts are up to date. */
    template <typename Use>
    void inflow(std::size_t l, const std::vector<double> &u, const Use &use) const
    {
      const ConductionRuns &conduction = levels[l].conduction;
      conduction.multiply(u.data(), [&](std::size_t i, double sum)
                          { use(i, sum - conduction.diagonal[i] * u[i]); });
    }

    /** Leaves v - u_c of the next coarser level in its `start`. */
    void solve_below(std::size_t l, std::vector<double> &on_graph,
                     std::vector<double> &heat, double scale)
    {
      State &below = states[l + 1];
      restrict_to(l + 1, on_graph, below.start);
      restrict_to(l + 1, heat, below.right_side);
      const std::size_t n = levels[l + 1].n_own();
      for(std::size_t i = 0; i < n; ++i)
        below.u[i] = levels[l + 1].free[i]
                         ? graph.kirchhoff(graph.temperature_excess_at_enthalpy(
                             factor * scale * below.start[i] / below.volume[i]))
                         : 0;
      exchange(l + 1, below.u);
      inflow(l + 1, below.u,
             [&](std::size_t i, double inflow_of)
             {
               below.right_side[i]
                   = scale * below.right_side[i] - inflow_of
                     + below.transfer[i] * graph.temperature_excess(below.u[i]);
             });
      std::copy_n(below.u.begin(), n, below.start.begin());
      solve_level(l + 1);
      for(std::size_t i = 0; i < n; ++i)
        below.start[i] = below.u[i] - below.start[i];
    }

    void sweep(std::size_t l, bool forward)
    {
      State &state = states[l];
      const ConductionRuns &conduction = levels[l].conduction;
      conduction.sweep(forward, state.right_side.data(), state.u.data(),
                       [&](std::size_t i, double heat)
                       {
                         return levels[l].free[i]
                                    ? graph.resolve(heat, state.volume[i] / factor,
                                                    conduction.diagonal[i],
                                                    state.transfer[i])
                                    : 0;
                       });
      exchange(l, state.u);
    }

    void solve_level(std::size_t l)
    {
      constexpr int sweeps_of_coarsest = 20, sweeps = 2;
      // W-cycles on the two finest of the coarse meshes only: every other visit sends
      // messages, and little else.
      const int visits = l <= 2 ? 2 : 1;
      if(l + 1 == levels.size())
      {
        for(int k = 0; k < sweeps_of_coarsest; ++k)
          sweep(l, k % 2 == 0);
        return;
      }
      for(int visit = 0; visit < visits; ++visit)
      {
        for(int k = 0; k < sweeps; ++k)
          sweep(l, k % 2 == 0);
        correct_level(l);
        for(int k = 0; k < sweeps; ++k)
          sweep(l, k % 2 != 0);
      }
    }

    void correct_level(std::size_t l)
    {
      State &state = states[l];
      inflow(l, state.u,
             [&](std::size_t i, double inflow_of)
             {
               const double heat
                   = state.right_side[i] + inflow_of
                     - state.transfer[i] * graph.temperature_excess(state.u[i]);
               const bool free = levels[l].free[i];
               state.heat[i] = free ? heat : 0;
               state.work[i] = free ? graph.heat_on_graph(state.u[i],
                                                          state.volume[i] / factor, heat)
                                    : 0;
             });
      solve_below(l, state.work, state.heat, 1);
      interpolate(l, [&](std::size_t i, double change) { state.work[i] = change; });
      const double length = search(l);
      for(std::size_t i = 0; i < levels[l].n_own(); ++i)
        state.u[i] += length * state.work[i];
      exchange(l, state.u);
    }

    /** The share of the direction `work` to go on a level. */
    double search(std::size_t l)
    {
      State &state = states[l];
      exchange(l, state.work);
      KinkedDerivative derivative;
      inflow(l, state.work,
             [&](std::size_t i, double inflow_of)
             {
               if(levels[l].free[i])
                 derivative.add_node(graph, state.u[i], state.work[i],
                                     state.volume[i] / factor, state.transfer[i],
                                     state.heat[i], -inflow_of);
             });
      return lowest_of_all(derivative, levels[l].communicator, traffic);
    }

    const std::vector<RankLevel> &levels;
    const Graph &graph;
    Traffic &traffic;
    std::vector<State> states;
    double factor = 1;
  };
} // namespace meltfront::reference_fem

#endif
