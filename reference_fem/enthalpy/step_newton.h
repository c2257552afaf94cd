#ifndef meltfront_reference_fem_enthalpy_step_newton_h
#define meltfront_reference_fem_enthalpy_step_newton_h

#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/front_moves.h>
#include <reference_fem/enthalpy/truncated_newton.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace meltfront::reference_fem
{
  /** What is to be done between the parts of a mesh that several processes share: nothing
   * where one has all of it. */
  struct OneProcess
  {
    void update(CompensatedVector &) const
    {
    }

    void update(std::vector<double> &) const
    {
    }

    bool anywhere(bool here) const
    {
      return here;
    }

    void agree(double &, double &, bool &) const
    {
    }

    template <typename Visit>
    void update_marks(std::vector<char> &, const Visit &) const
    {
    }
  };

  /**
   * What truncated Newton methods have in common whatever the graph: the outer iteration,
   * the sweeps, and how far a state is off the graph.
   *
   * Solver derives from it and gives: `jumps` (whether its graph does, so that sweeps are
   * needed); `exchanges` (whether walls exchange heat); `excess(u)`, T - T_m (K);
   * `excess_at_enthalpy(i, H)`, the same by a node's enthalpy per volume (J/m^3);
   * `latent_temperature()`, L/c (K); `same_side(i, u, t)`, whether an unknown is in the
   * region of its graph that a temperature excess tells; `moves_fronts`, whether there
   * are `has_coarser_meshes()`, `correct_coarsely(c, u, heat)`, `add_slope_of_jump(u,
   * heat)` and `descend_over_jumps(c, u, heat)`, which move fronts far; `relax(i, c, rhs,
   * u)`, which solves one node's inclusion and tells whether it moved to another region;
   * `linearise(c, u, heat)`, which fills heat_capacity, active and residual and returns
   * the heat that changes a typical active node by one kelvin (J); `descend(c, u, heat)`,
   * which goes along the direction.
   *
   * Where processes share the mesh, the problem's nodes are this one's own; u has ghosts
   * after them, nodes of others, which stand still in half a sweep.
   * @tparam Processes `update(u)` brings the ghosts up to date; `anywhere(here)`, whether
   * something holds on any process; `agree(distance, largest, settled)` takes the two
   * numbers' maxima and whether all are settled; `update_marks(marked, mark_around)`
   * brings marks of the ghosts up to date and calls mark_around(neighbour) of the own
   * neighbours of those newly marked
   */
  template <class Solver, class Processes = OneProcess>
  class StepNewton
  {
  protected:
    StepNewton(const StepProblem &problem, LinearSolver &linear_solver,
               Processes processes = {})
      : problem(problem)
      , linear_solver(linear_solver)
      , processes(std::move(processes))
      , active(problem.free)
      , heat_capacity(problem.free.size())
      , residual(problem.free.size())
      , direction(problem.free.size())
    {
    }

    /** As NonlinearSolver::solve. */
    StepOutcome iterate(double c, const std::vector<double> &rhs, int iteration_limit,
                        CompensatedVector &u, std::vector<double> &heat)
    {
      FrontMoves front_moves(has_coarser_meshes());
      StepOutcome outcome;
      direction.resize(u.size());
      processes.update(u);
      for(;; ++outcome.iterations)
      {
        if constexpr(Solver::exchanges)
          problem.exchange->follow([&](std::size_t i) { return solver().excess(u[i]); });
        recover_heat(c, rhs, u, heat);
        const Consistency state = compare(u, heat);
        outcome.graph_inconsistency = state.distance;
        outcome.converged = state.distance <= NonlinearSolver::target_inconsistency;
        if(outcome.converged)
          scale = state.scale;
        if(outcome.converged || outcome.iterations == iteration_limit
           || !std::isfinite(state.distance))
          break;
        if constexpr(Solver::jumps)
          if(!state.settled)
          {
            const cases::ScopedTimer timer(cost.seconds);
            move_nodes(c, rhs, u, heat);
            if constexpr(Solver::moves_fronts)
              if(front_moves.correct_coarsely(outcome.iterations,
                                              [this] { return fronts_go_far(); }))
              {
                solver().correct_coarsely(c, u, heat);
                recover_heat(c, rhs, u, heat);
                move_nodes(c, rhs, u, heat);
              }
          }
        take_newton_step(c, state,
                         !state.settled && front_moves.count_slope(outcome.iterations), u,
                         heat);
      }
      if(!outcome.converged)
        outcome.converged
            = outcome.graph_inconsistency <= NonlinearSolver::accepted_inconsistency;
      return outcome;
    }

    std::size_t n_own() const
    {
      return problem.free.size();
    }

    StepProblem problem;
    LinearSolver &linear_solver;
    Processes processes;
    std::vector<char> active;
    std::vector<double> heat_capacity, residual, direction;
    double scale = 0; ///< largest |T - T_m| of the steps solved so far
    long entries_touched = 0;
    NonlinearSolver::GraphCost cost;

  private:
    /** The share of rho L/(rho c) below which temperatures drown in its round-off. */
    static constexpr double round_off_share = 1e-3;

    struct Consistency
    {
      double distance; ///< max |T(u) - T(H)| over the scale
      double scale;    ///< see StepOutcome::graph_inconsistency
      bool settled;    ///< every node is in the region of its heat
    };

    Solver &solver()
    {
      return static_cast<Solver &>(*this);
    }

    const Solver &solver() const
    {
      return static_cast<const Solver &>(*this);
    }

    bool has_coarser_meshes() const
    {
      if constexpr(Solver::moves_fronts)
        return solver().has_coarser_meshes();
      return false;
    }

    /** Newton's step for the active nodes.
     * @param slope whether it counts the slope of the jump, where fronts can be moved */
    void take_newton_step(double c, const Consistency &state, bool slope,
                          CompensatedVector &u, std::vector<double> &heat)
    {
      constexpr double loose = 1e-3, tight = 1e-12, safety = 0.1;
      const double heat_per_kelvin = solver().linearise(c, u, heat);
      if constexpr(Solver::moves_fronts)
        if(slope)
          solver().add_slope_of_jump(u, heat);
      linear_solver.solve({heat_capacity, c, active, residual,
                           safety * NonlinearSolver::target_inconsistency * state.scale
                               * heat_per_kelvin * problem.least_volume},
                          state.settled ? tight : loose, direction);
      if constexpr(Solver::moves_fronts)
        if(slope)
        {
          solver().descend_over_jumps(c, u, heat);
          return;
        }
      solver().descend(c, u, heat);
    }

    void recover_heat(double c, const std::vector<double> &rhs,
                      const CompensatedVector &u, std::vector<double> &heat)
    {
      for(std::size_t i = 0; i < n_own(); ++i)
        recover_heat_of(i, c, rhs, u, heat);
      if constexpr(Solver::exchanges)
        problem.exchange->visit([&](std::size_t i) { exchange_heat_of(i, c, u, heat); });
      entries_touched += problem.conduction.entries();
    }

    void recover_heat_of(std::size_t i, double c, const std::vector<double> &rhs,
                         const CompensatedVector &u, std::vector<double> &heat) const
    {
      if(problem.free[i])
        heat[i] = static_cast<double>(rhs[i] + c * problem.conduction.exact_inflow(i, u));
    }

    void exchange_heat_of(std::size_t i, double c, const CompensatedVector &u,
                          std::vector<double> &heat) const
    {
      heat[i] += c
                 * (problem.exchange->supply[i]
                    - problem.exchange->transfer[i] * solver().excess(u[i]));
    }

    Consistency compare(const CompensatedVector &u, const std::vector<double> &heat)
    {
      double distance = 0, largest = 0;
      bool settled = true;
      for(std::size_t i = 0; i < n_own(); ++i)
      {
        const double excess = solver().excess(u[i]);
        largest = std::max(largest, std::abs(excess));
        if(!problem.free[i])
          continue;
        const double recovered
            = solver().excess_at_enthalpy(i, heat[i] / problem.volume[i]);
        const double off = std::abs(excess - recovered);
        if(off > distance || std::isnan(off))
          distance = off;
        settled = settled && solver().same_side(i, u[i], recovered);
      }
      processes.agree(distance, largest, settled);
      largest
          = std::max({largest, scale, round_off_share * solver().latent_temperature()});
      return {largest > 0 ? distance / largest : distance, largest, settled};
    }

    /** Sweeps while nodes move to other regions; then the heats they lead to. */
    void move_nodes(double c, const std::vector<double> &rhs, CompensatedVector &u,
                    std::vector<double> &heat)
    {
      const auto relax = [&](std::size_t i)
      { return problem.free[i] && solver().relax(i, c, rhs, u); };
      if constexpr(Solver::moves_fronts)
      {
        const std::size_t swept = find_nodes_at_fronts(u, heat);
        sweep_while_moving(u, swept, [&](std::size_t k) { return relax(at_fronts[k]); });
        for(const unsigned int i : at_fronts)
          recover_heat_of(i, c, rhs, u, heat);
        if constexpr(Solver::exchanges)
          problem.exchange->visit(
              [&](std::size_t i)
              {
                if(near_front[i])
                  exchange_heat_of(i, c, u, heat);
              });
      }
      else
      {
        sweep_while_moving(u, n_own(), relax);
        recover_heat(c, rhs, u, heat);
      }
    }

    /**
     * The nodes within some layers of those that are not in the region of their heat or
     * that have a neighbour in another region. Sweeps elsewhere move no front: they do
     * what Newton's step does better.
     * @return how many of `at_fronts` are to be swept, the first ones; the others are
     * their neighbours
     */
    std::size_t find_nodes_at_fronts(const CompensatedVector &u,
                                     const std::vector<double> &heat)
    {
      constexpr int layers = 4;
      const ConductionMatrix &conduction = problem.conduction;
      const auto neighbours_elsewhere = [&](std::size_t i)
      {
        for(std::size_t k = conduction.row_start[i]; k < conduction.row_start[i + 1]; ++k)
          if(const double there = u[conduction.column[k]];
             (there > 0) != (u[i] > 0) || (there < 0) != (u[i] < 0))
            return true;
        return false;
      };
      near_front.assign(u.size(), 0);
      at_fronts.clear();
      n_off_region = n_at_front = 0;
      for(std::size_t i = 0; i < n_own(); ++i)
      {
        const bool at_front = neighbours_elsewhere(i);
        const bool off_region
            = problem.free[i]
              && !solver().same_side(
                  i, u[i], solver().excess_at_enthalpy(i, heat[i] / problem.volume[i]));
        n_at_front += at_front;
        n_off_region += off_region;
        if(at_front || off_region)
        {
          near_front[i] = 1;
          at_fronts.push_back(static_cast<unsigned int>(i));
        }
      }
      const auto mark = [&](unsigned int i)
      {
        if(i < n_own() && !near_front[i])
        {
          near_front[i] = 1;
          at_fronts.push_back(i);
        }
      };
      std::size_t first = 0, swept = 0;
      for(int layer = 0; layer <= layers; ++layer)
      {
        swept = at_fronts.size();
        processes.update_marks(near_front, mark);
        for(; first < swept; ++first)
        {
          const std::size_t i = at_fronts[first];
          for(std::size_t k = conduction.row_start[i]; k < conduction.row_start[i + 1];
              ++k)
            mark(conduction.column[k]);
        }
      }
      std::sort(at_fronts.begin(),
                at_fronts.begin() + static_cast<std::ptrdiff_t>(swept));
      return swept;
    }

    /** Whether there are more than twice as many nodes off the region of their heat as
     * fronts have beside them, some six layers, when nodes at fronts were found last. */
    bool fronts_go_far() const
    {
      double off_region = double(n_off_region), at_front = double(n_at_front);
      processes.add_up(off_region, at_front);
      return off_region > 2 * at_front;
    }

    /** Symmetric sweeps of nonlinear Gauss-Seidel, there and back.
     * @param relax of the k-th node; true if it moved to another region */
    template <typename Relax>
    void sweep_while_moving(CompensatedVector &u, std::size_t nodes, const Relax &relax)
    {
      constexpr int most_sweeps = 4;
      bool moved = true;
      for(int sweeps = 0; sweeps < most_sweeps && moved; ++sweeps)
      {
        moved = false;
        for(std::size_t k = 0; k < nodes; ++k)
          moved |= relax(k);
        processes.update(u);
        for(std::size_t k = nodes; k-- > 0;)
          moved |= relax(k);
        processes.update(u);
        moved = processes.anywhere(moved);
        entries_touched += static_cast<long>(2 * nodes * problem.conduction.entries()
                                             / problem.conduction.size());
        ++cost.sweeps;
      }
    }

    std::vector<unsigned int> at_fronts; ///< find_nodes_at_fronts()
    std::vector<char> near_front;        ///< by node: whether it is among them
    /** Of the own nodes those that are not in the region of their heat, and those that
     * have a neighbour in another region than their own. */
    std::size_t n_off_region = 0, n_at_front = 0;
  };
} // namespace meltfront::reference_fem

#endif
