#ifndef meltfront_reference_fem_enthalpy_mush_newton_h
#define meltfront_reference_fem_enthalpy_mush_newton_h

#include <reference_fem/enthalpy/mush_graph.h>
#include <reference_fem/enthalpy/step_newton.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Solves the inclusion of an implicit step for an alloy whose composition and
   * conductivities are given,
   *
   *   volume_i H_i(t_i) + c (K t)_i = rhs_i + c (what the walls exchange),
   *
   * t = T - T_m, K the stiffness with the conductivities in it, and H_i the graph of the
   * node's composition: the minimum of a convex functional, since every H_i rises, as
   * what walls exchange with their surroundings falls.
   *
   * Method: truncated nonsmooth Newton as for the pure substance (Graeser and Kornhuber
   * 2009, without coarse levels). Only the jumps, at the eutectic temperature and at
   * nodes without solute, are truncated; kinks at the liquidus are left to the sweeps and
   * to the line search, which makes the functional fall in every iteration.
   */
  class MushSolver
  {
  public:
    virtual ~MushSolver() = default;

    /** As NonlinearSolver::solve, u being t (K). */
    virtual StepOutcome solve(double c, const std::vector<double> &rhs,
                              int iteration_limit, CompensatedVector &u,
                              std::vector<double> &heat)
        = 0;

    /** Matrix entries touched, without the linear solver's. */
    virtual long work() const = 0;

    virtual const NonlinearSolver::GraphCost &graph_cost() const = 0;
  };

  std::unique_ptr<MushSolver>
  make_mush_solver(const StepProblem &problem, const MushGraph &graph,
                   const std::vector<Composition> &composition,
                   LinearSolver &linear_solver);

  /** @tparam with_exchange walls exchange heat with their surroundings */
  template <bool with_exchange>
  class MushNewton : public MushSolver, private StepNewton<MushNewton<with_exchange>>
  {
  public:
    MushNewton(const StepProblem &problem, const MushGraph &graph,
               const std::vector<Composition> &composition, LinearSolver &linear_solver);

    StepOutcome solve(double c, const std::vector<double> &rhs, int iteration_limit,
                      CompensatedVector &u, std::vector<double> &heat) override
    {
      return this->iterate(c, rhs, iteration_limit, u, heat);
    }

    long work() const override
    {
      return entries_touched;
    }

    const NonlinearSolver::GraphCost &graph_cost() const override
    {
      return cost;
    }

  private:
    using Base = StepNewton<MushNewton<with_exchange>>;
    friend Base;
    using Base::active;
    using Base::cost;
    using Base::direction;
    using Base::entries_touched;
    using Base::heat_capacity;
    using Base::problem;
    using Base::residual;
    static constexpr bool jumps = true;
    static constexpr bool exchanges = with_exchange;
    static constexpr bool moves_fronts = false;

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
