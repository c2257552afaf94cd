#ifndef meltfront_reference_fem_enthalpy_mush_newton_h
#define meltfront_reference_fem_enthalpy_mush_newton_h

#include <reference_fem/enthalpy/mush_graph.h>
#include <reference_fem/enthalpy/step_newton.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Solves the inclusion of an implicit step for an alloy whose composition and
   * conductivities are given,
   *
   *   volume_i H_i(t_i) + c (K t)_i = rhs_i,
   *
   * t = T - T_m, K the stiffness with the conductivities in it, and H_i the graph of the
   * node's composition: the minimum of a convex functional, since every H_i rises.
   *
   * Method: truncated nonsmooth Newton as for the pure substance (Graeser and Kornhuber
   * 2009, without coarse levels). Only the jumps, at the eutectic temperature and at
   * nodes without solute, are truncated; kinks at the liquidus are left to the sweeps and
   * to the line search, which makes the functional fall in every iteration.
   */
  class MushNewton : private StepNewton<MushNewton>
  {
  public:
    MushNewton(const StepProblem &problem, const MushGraph &graph,
               const std::vector<Composition> &composition, LinearSolver &linear_solver);

    /** As NonlinearSolver::solve, u being t (K). */
    StepOutcome solve(double c, const std::vector<double> &rhs, int iteration_limit,
                      CompensatedVector &u, std::vector<double> &heat);

    /** Matrix entries touched, without the linear solver's. */
    long work() const
    {
      return entries_touched;
    }

    const NonlinearSolver::GraphCost &graph_cost() const
    {
      return cost;
    }

  private:
    friend class StepNewton<MushNewton>;
    static constexpr bool jumps = true;
    static constexpr bool exchanges = false;

    double excess(double u) const
    {
      return u;
    }

    double excess_at_enthalpy(std::size_t i, double enthalpy) const
    {
      return graph.excess_at_enthalpy(enthalpy, composition[i]);
    }

    double latent_temperature() const
    {
      return graph.latent_temperature();
    }

    bool same_side(std::size_t i, double u, double recovered) const
    {
      return graph.region(u, composition[i]) == graph.region(recovered, composition[i]);
    }

    bool relax(std::size_t i, double c, const std::vector<double> &rhs,
               CompensatedVector &u);
    double linearise(double c, const CompensatedVector &u,
                     const std::vector<double> &heat);
    void descend(double c, CompensatedVector &u, const std::vector<double> &heat);
    void project(const CompensatedVector &u);
    double line_search(double c, const CompensatedVector &u,
                       const std::vector<double> &heat);
    double fall(double length, double conducted, const CompensatedVector &u,
                const std::vector<double> &heat) const;
    double moved(std::size_t i, double length, const CompensatedVector &u) const;
    void advance(double length, CompensatedVector &u) const;

    const MushGraph &graph;
    const std::vector<Composition> &composition; ///< by node
  };
} // namespace meltfront::reference_fem

#endif
