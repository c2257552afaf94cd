#ifndef meltfront_reference_fem_enthalpy_coarse_correction_h
#define meltfront_reference_fem_enthalpy_coarse_correction_h

#include <reference_fem/enthalpy/lattice_matrix.h>
#include <reference_fem/enthalpy/line_search.h>
#include <reference_fem/enthalpy/linear_solver.h>
#include <reference_fem/enthalpy/truncated_newton.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /** Moves fronts by many cells at once: CoarseCorrection on levels of any kind. */
  class FrontMover
  {
  public:
    virtual ~FrontMover() = default;

    /**
     * @param on_graph by node: the heat V H that lies on the graph at u (J)
     * @param heat by node: that which the balance asks for (J)
     * @param transfer by node, to the surroundings (W/K); null: none
     * @param correction P (v - u_c) is added to it
     */
    virtual void
    correct(double c, const std::vector<char> &free, const std::vector<double> &on_graph,
            const std::vector<double> &heat, const std::vector<double> *transfer,
            std::vector<double> &correction)
        = 0;
  };

  /**
   * A correction of the inclusion of a step from coarser meshes, which moves a front by
   * many cells at once: the full approximation scheme (Brandt 1977) for the enthalpy.
   *
   * A sweep of Gauss-Seidel moves a front by a cell or two, and the linear correction of
   * truncated Newton does not move it at all. A coarse mesh poses the same inclusion
   * with its own volumes V_c = P'V, its conductances P'K P and the heat of its nodes:
   * H_c = P'(V H)/V_c, whose place on the graph is u_c. It is solved for
   *
   *   V_c H(v) + c K_c v + c T_c (T(v) - T_m) = P'heat + c K_c u_c + c T_c (T(u_c) -
   * T_m),
   *
   * so that P (v - u_c) vanishes where the fine inclusion is solved, and is a direction
   * in which its functional falls elsewhere, since the coarse graph rises. How far it is
   * gone along is up to an exact line search, on every level.
   *
   * On coarse levels heats are over c, the factor of the step.
   */
  template <class Graph, class Level>
  class CoarseCorrection : public FrontMover
  {
  public:
    /** @param levels live as long as this */
    CoarseCorrection(const std::vector<Level> &levels, const StepProblem &problem,
                     const Graph &graph)
      : levels(levels)
      , graph(graph)
      , states(levels.size())
    {
      const Matrix finest(levels.front(), problem.conduction);
      matrices.reserve(levels.size() - 1);
      for(std::size_t l = 1; l < levels.size(); ++l)
      {
        const char *mask = l == 1 ? problem.free.data() : nullptr;
        const Matrix &finer = l == 1 ? finest : matrices.back();
        matrices.emplace_back(levels[l]).restrict_from(finer, finer.diagonal, mask);
        State &state = states[l];
        levels[l - 1].restrict_to(l == 1 ? problem.volume : states[l - 1].volume, mask,
                                  state.volume);
        for(auto *field : {&state.u, &state.start, &state.right_side, &state.heat})
          field->resize(levels[l].size());
      }
    }

    void correct(double c, const std::vector<char> &free,
                 const std::vector<double> &on_graph, const std::vector<double> &heat,
                 const std::vector<double> *transfer,
                 std::vector<double> &correction) override
    {
      factor = c;
      if(transfer)
        for(std::size_t l = 1; l < levels.size(); ++l)
          levels[l - 1].restrict_to(l == 1 ? *transfer : states[l - 1].transfer,
                                    l == 1 ? free.data() : nullptr, states[l].transfer);
      solve_below(0, on_graph, heat, 1 / c, free.data());
      levels[0].add_interpolated(states[1].start, free.data(), correction);
    }

  private:
    using Matrix = typename Level::Matrix;

    struct State
    {
      std::vector<double> volume, transfer;
      std::vector<double> u, start, right_side, heat;
    };

    double transfer(const State &state, std::size_t i) const
    {
      return state.transfer.empty() ? 0 : state.transfer[i];
    }

    /** Leaves v - u_c of the next coarser level in its `start`. */
    void solve_below(std::size_t l, const std::vector<double> &on_graph,
                     const std::vector<double> &heat, double scale, const char *mask)
    {
      State &below = states[l + 1];
      levels[l].restrict_to(on_graph, mask, below.start);
      levels[l].restrict_to(heat, mask, below.right_side);
      for(std::size_t i = 0; i < below.u.size(); ++i)
        below.start[i] = below.volume[i] > 0
                             ? graph.kirchhoff(graph.temperature_excess_at_enthalpy(
                                 factor * scale * below.start[i] / below.volume[i]))
                             : 0;
      below.u = below.start;
      // K u_c is added, and what the walls take.
      std::fill(below.heat.begin(), below.heat.end(), 0);
      add_inflow(matrices[l], below.u, below.heat);
      for(std::size_t i = 0; i < below.u.size(); ++i)
        below.right_side[i] = scale * below.right_side[i] - below.heat[i]
                              + transfer(below, i) * graph.temperature_excess(below.u[i]);
      solve_level(l + 1);
      for(std::size_t i = 0; i < below.u.size(); ++i)
        below.start[i] = below.u[i] - below.start[i];
    }

    /** heat -= K u. */
    static void add_inflow(const Matrix &matrix, const std::vector<double> &u,
                           std::vector<double> &heat)
    {
      matrix.subtract_product(matrix.diagonal, u, heat);
    }

    void sweep(std::size_t l, bool forward)
    {
      State &state = states[l];
      const Matrix &matrix = matrices[l - 1];
      matrix.sweep(forward, state.right_side, state.u,
                   [&](std::size_t i, double heat)
                   {
                     return state.volume[i] > 0
                                ? graph.resolve(heat, state.volume[i] / factor,
                                                matrix.diagonal[i], transfer(state, i))
                                : 0;
                   });
    }

    void solve_level(std::size_t l)
    {
      constexpr int sweeps_of_coarsest = 20, sweeps = 2;
      if(l + 1 == levels.size())
      {
        for(int k = 0; k < sweeps_of_coarsest; ++k)
          sweep(l, k % 2 == 0);
        return;
      }
      const int visits = levels.front().visits();
      State &state = states[l];
      std::vector<double> work(state.u.size());
      for(int visit = 0; visit < visits; ++visit)
      {
        for(int k = 0; k < sweeps; ++k)
          sweep(l, k % 2 == 0);
        correct_level(l, work);
        for(int k = 0; k < sweeps; ++k)
          sweep(l, k % 2 != 0);
      }
    }

    void correct_level(std::size_t l, std::vector<double> &work)
    {
      State &state = states[l];
      state.heat = state.right_side;
      add_inflow(matrices[l - 1], state.u, state.heat);
      std::vector<double> &on_graph = work, &direction = work;
      for(std::size_t i = 0; i < state.u.size(); ++i)
      {
        state.heat[i] -= transfer(state, i) * graph.temperature_excess(state.u[i]);
        on_graph[i]
            = graph.heat_on_graph(state.u[i], state.volume[i] / factor, state.heat[i]);
      }
      solve_below(l, on_graph, state.heat, 1, nullptr);
      std::fill(direction.begin(), direction.end(), 0);
      levels[l].add_interpolated(states[l + 1].start, nullptr, direction);
      const double length = search(l, direction);
      for(std::size_t i = 0; i < state.u.size(); ++i)
        state.u[i] += length * direction[i];
    }

    /** The share of a direction to go on a level. */
    double search(std::size_t l, const std::vector<double> &direction)
    {
      State &state = states[l];
      KinkedDerivative derivative;
      std::vector<double> inflow(direction.size());
      add_inflow(matrices[l - 1], direction, inflow);
      for(std::size_t i = 0; i < direction.size(); ++i)
        derivative.add_node(graph, state.u[i], direction[i], state.volume[i] / factor,
                            transfer(state, i), state.heat[i], -inflow[i]);
      return derivative.lowest();
    }

    const std::vector<Level> &levels;
    const Graph &graph;
    std::vector<Matrix> matrices; ///< K from the second level on
    std::vector<State> states;
    double factor = 1;
  };

  template <class Graph>
  std::unique_ptr<FrontMover> make_front_mover(const StepProblem &problem,
                                               const Graph &graph)
  {
    return std::visit(
        [&]<class Level>(const std::vector<Level> &levels) -> std::unique_ptr<FrontMover>
        {
          return std::make_unique<CoarseCorrection<Graph, Level>>(levels, problem, graph);
        },
        *problem.levels);
  }
} // namespace meltfront::reference_fem

#endif
