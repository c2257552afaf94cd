#ifndef meltfront_reference_fem_enthalpy_distributed_rank_correction_h
#define meltfront_reference_fem_enthalpy_distributed_rank_correction_h

#include <reference_fem/enthalpy/distributed/rank_solver.h>
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
  class RankCorrection
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
        for(RankVector *field :
            {&states[l].volume, &states[l].transfer, &states[l].u, &states[l].start,
             &states[l].right_side, &states[l].heat, &states[l].work})
          if(l > 0 || field == &states[l].volume || field == &states[l].heat
             || field == &states[l].work)
            field->reinit(levels[l].nodes);
      take(volume, states[0].volume);
      for(std::size_t l = 1; l < levels.size(); ++l)
        restrict_to(l, states[l - 1].volume, states[l].volume);
    }

    /**
     * @param on_graph by own node: the heat V H that lies on the graph at u (J)
     * @param heat by own node: that which the balance asks for (J)
     * @param transfer by own node, to the surroundings (W/K); null: none
     * @param correction P (v - u_c) at the own nodes
     */
    void correct(double c, const std::vector<double> &on_graph,
                 const std::vector<double> &heat, const std::vector<double> *transfer,
                 std::vector<double> &correction)
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
      interpolate(0, finest.work);
      for(unsigned int i = 0; i < levels.front().n_own(); ++i)
        correction[i] = finest.work.local_element(i);
    }

  private:
    struct State
    {
      RankVector volume, transfer, u, start, right_side, heat, work;
    };

    /** To own nodes that are free; zero at the others. */
    void take(const std::vector<double> &values, RankVector &result) const
    {
      for(unsigned int i = 0; i < levels.front().n_own(); ++i)
        result.local_element(i) = levels.front().free[i] ? values[i] : 0;
    }

    void mask(std::size_t l, RankVector &values) const
    {
      for(unsigned int i = 0; i < levels[l].n_own(); ++i)
        if(!levels[l].free[i])
          values.local_element(i) = 0;
    }

    void count_transfer(std::size_t finer)
    {
      traffic.exchanges += 2;
      traffic.sent += levels[finer].nodes->n_import_indices()
                      + levels[finer + 1].nodes->n_import_indices();
    }

    /** result = P' values, to level l. */
    void restrict_to(std::size_t l, const RankVector &values, RankVector &result)
    {
      result = 0;
      levels[l - 1].coarser->restrict_to(values, result);
      mask(l, result);
      count_transfer(l - 1);
    }

    /** result = P (v - u_c), from the level below l. */
    void interpolate(std::size_t l, RankVector &result)
    {
      result = 0;
      levels[l].coarser->interpolate(states[l + 1].start, result);
      mask(l, result);
      count_transfer(l);
    }

    void exchange(std::size_t l, const RankVector &values)
    {
      values.update_ghost_values();
      ++traffic.exchanges;
      traffic.sent += levels[l].nodes->n_import_indices();
    }

    /** -(K u)_i on a level; ghosts are up to date. */
    double inflow(std::size_t l, std::size_t i, const double *u) const
    {
      const ConductionMatrix &k = levels[l].conduction;
      double sum = 0;
      for(std::size_t e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
        sum += k.conductance[e] * (u[k.column[e]] - u[i]);
      return sum;
    }

    /** Leaves v - u_c of the next coarser level in its `start`. */
    void solve_below(std::size_t l, const RankVector &on_graph, const RankVector &heat,
                     double scale)
    {
      State &below = states[l + 1];
      restrict_to(l + 1, on_graph, below.start);
      restrict_to(l + 1, heat, below.right_side);
      const auto n = static_cast<unsigned int>(levels[l + 1].n_own());
      for(unsigned int i = 0; i < n; ++i)
        below.u.local_element(i)
            = levels[l + 1].free[i]
                  ? graph.kirchhoff(graph.temperature_excess_at_enthalpy(
                      factor * scale * below.start.local_element(i)
                      / below.volume.local_element(i)))
                  : 0;
      exchange(l + 1, below.u);
      for(unsigned int i = 0; i < n; ++i)
      {
        const double u = below.u.local_element(i);
        below.right_side.local_element(i)
            = scale * below.right_side.local_element(i)
              - inflow(l + 1, i, below.u.begin())
              + below.transfer.local_element(i) * graph.temperature_excess(u);
        below.start.local_element(i) = u;
      }
      solve_level(l + 1);
      for(unsigned int i = 0; i < n; ++i)
        below.start.local_element(i)
            = below.u.local_element(i) - below.start.local_element(i);
    }

    void sweep(std::size_t l, bool forward)
    {
      State &state = states[l];
      const ConductionMatrix &k = levels[l].conduction;
      const std::size_t n = levels[l].n_own();
      double *u = state.u.begin();
      for(std::size_t step = 0; step < n; ++step)
      {
        const std::size_t i = forward ? step : n - 1 - step;
        if(!levels[l].free[i])
          continue;
        double heat = state.right_side.begin()[i];
        for(std::size_t e = k.row_start[i]; e < k.row_start[i + 1]; ++e)
          heat += k.conductance[e] * u[k.column[e]];
        u[i] = graph.resolve(heat, state.volume.begin()[i] / factor, k.diagonal[i],
                             state.transfer.begin()[i]);
      }
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
      const auto n = static_cast<unsigned int>(levels[l].n_own());
      for(unsigned int i = 0; i < n; ++i)
      {
        const double u = state.u.local_element(i);
        const double heat
            = state.right_side.local_element(i) + inflow(l, i, state.u.begin())
              - state.transfer.local_element(i) * graph.temperature_excess(u);
        state.heat.local_element(i) = levels[l].free[i] ? heat : 0;
        state.work.local_element(i)
            = levels[l].free[i]
                  ? graph.heat_on_graph(u, state.volume.local_element(i) / factor, heat)
                  : 0;
      }
      solve_below(l, state.work, state.heat, 1);
      interpolate(l, state.work);
      const double length = search(l);
      for(unsigned int i = 0; i < n; ++i)
        state.u.local_element(i) += length * state.work.local_element(i);
      exchange(l, state.u);
    }

    /** The share of the direction `work` to go on a level. */
    double search(std::size_t l)
    {
      State &state = states[l];
      exchange(l, state.work);
      KinkedDerivative derivative;
      for(unsigned int i = 0; i < levels[l].n_own(); ++i)
        if(levels[l].free[i])
          derivative.add_node(
              graph, state.u.local_element(i), state.work.local_element(i),
              state.volume.local_element(i) / factor, state.transfer.local_element(i),
              state.heat.local_element(i), -inflow(l, i, state.work.begin()));
      return lowest_of_all(derivative, levels[l].communicator(), traffic);
    }

    const std::vector<RankLevel> &levels;
    const Graph &graph;
    Traffic &traffic;
    std::vector<State> states;
    double factor = 1;
  };
} // namespace meltfront::reference_fem

#endif
