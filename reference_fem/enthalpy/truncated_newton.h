#ifndef meltfront_reference_fem_enthalpy_truncated_newton_h
#define meltfront_reference_fem_enthalpy_truncated_newton_h

#include <cases/effects.h>
#include <cases/material.h>
#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/linear_solver.h>
#include <reference_fem/enthalpy/wall_exchange.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /** How the solution of one step ended. */
  struct StepOutcome
  {
    bool converged = false;
    int iterations = 0;
    /**
     * How far the state is off the graph: max |T(u) - T(H)| over the largest |T - T_m| of
     * the run so far, but at least over a thousandth of L/c, since the latent heat's own
     * round-off sets a floor.
     */
    double graph_inconsistency = 0;
    /** Of an alloy: the last change by a pass, see AlloySolver::coupling_tolerance. */
    double coupling_defect = 0;
  };

  /** The fixed parts of the problem that every step solves. */
  struct StepProblem
  {
    const ConductionMatrix &conduction;
    const std::vector<double> &volume; ///< by node, the lumped mass
    const std::vector<char> &free;     ///< 0 where a wall prescribes the temperature
    WallExchange *exchange = nullptr;  ///< null: walls exchange no heat
    /** Of the nodes, where there are coarser ones: these move fronts far. */
    const Levels *levels = nullptr;
    /** The least volume over the typical one: what is left of the heat of a large node
     * would be much for a small one. */
    double least_volume = 1;
  };

  /**
   * Solves, for all free nodes i, the inclusion of an implicit step
   *
   *   volume_i H(u_i) + c (K u)_i = rhs_i + c (what the walls exchange)
   *
   * with H the enthalpy graph: the minimum of the convex functional
   * J(u) = sum volume_i Psi(u_i) + c/2 u'Ku - rhs'u, Psi' = H.
   *
   * Method: truncated nonsmooth Newton multigrid (Graeser and Kornhuber 2009). Each
   * iteration makes nonlinear Gauss-Seidel sweeps, which move nodes on and off the jump;
   * a Newton step for the nodes off the jump (u != 0); a projection, so that no node
   * passes the jump; and an exact line search on J. Plain semismooth Newton cycles once
   * the front crosses several cells in a step, and this iteration moves a front by some
   * cells only. So from the second iteration on, and at once where twice as many nodes
   * are not in the region of their heat as lie beside fronts, a CoarseCorrection moves it
   * first while there are such nodes. Of Newton's steps the one with the first
   * correction, the fourth after it (the second where there is no coarser mesh) and every
   * other one from there count the latent heat that a moving front takes as a slope of
   * the graph's jump. Without a jump J is smooth, and Newton's method with the line
   * search needs neither sweep nor projection.
   *
   * The enthalpy is then volume_i H_i = rhs_i - c (K u)_i, so heat is conserved whatever
   * u is; what tells whether the step is solved is that H_i and u_i lie on the graph.
   */
  class NonlinearSolver
  {
  public:
    virtual ~NonlinearSolver() = default;

    /** Off-graph distance (StepOutcome::graph_inconsistency) aimed at. */
    static constexpr double target_inconsistency = 1e-12;

    /** Off-graph distance that a step must keep to be accepted. */
    static constexpr double accepted_inconsistency = 1e-11;

    /**
     * @param c step size over the leading coefficient of the time scheme (s)
     * @param rhs right-hand side by node (J)
     * @param u Kirchhoff's variable: first guess (prescribed nodes: their value) and
     * solution
     * @param heat volume_i H_i of the free nodes (J)
     */
    virtual StepOutcome solve(double c, const std::vector<double> &rhs,
                              int iteration_limit, CompensatedVector &u,
                              std::vector<double> &heat)
        = 0;

    virtual double temperature_excess(double u) const = 0;
    /** Kirchhoff's variable of a node where the enthalpy per volume is H (J/m^3). */
    virtual double kirchhoff_at_enthalpy(std::size_t node, double enthalpy) const = 0;
    virtual double kirchhoff(double temperature_excess) const = 0;

    /** Largest |T - T_m| of the steps solved so far (K), which off-graph distances are
     * over, of a solver whose runs can be resumed. */
    virtual double temperature_scale() const
    {
      return 0;
    }

    /** Go on from that of an earlier part of the run. */
    virtual void set_temperature_scale(double)
    {
    }

    /** Matrix entries touched, the linear solver's included. */
    virtual long work() const = 0;

    /** What the effects that the graph is composed from cost so far. */
    struct GraphCost
    {
      long sweeps = 0;         ///< nonlinear sweeps: calls of phase_change
      long bytes = 0;          ///< arrays of the truncation
      double seconds = 0;      ///< in sweeps
      long linearisations = 0; ///< uses of the phases' two slopes
    };
    virtual GraphCost graph_cost() const = 0;
  };

  /** The solver for the graph that the effects compose. */
  std::unique_ptr<NonlinearSolver>
  make_nonlinear_solver(const StepProblem &problem, const cases::Material &material,
                        const cases::EffectSet &effects,
                        std::unique_ptr<LinearSolver> linear_solver);
} // namespace meltfront::reference_fem

#endif
