#ifndef meltfront_reference_fem_enthalpy_alloy_solver_h
#define meltfront_reference_fem_enthalpy_alloy_solver_h

#include <cases/scene.h>
#include <reference_fem/enthalpy/anderson_mixing.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/mush_conduction.h>
#include <reference_fem/enthalpy/mush_newton.h>
#include <reference_fem/enthalpy/solute_diffusion.h>
#include <reference_fem/enthalpy/time_scheme.h>

#include <memory>
#include <optional>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * The effects solute, solute_diffusion and eutectic: heat and solutes of an alloy in
   * local equilibrium. The unknown is t = T - T_m itself, since no variable of
   * Kirchhoff's is common to nodes of different composition (see MushConduction).
   *
   * A step is coupled by passes: heat with given conductivities and composition
   * (MushNewton), then solute in the liquid that this leaves (SoluteDiffusion), until
   * nothing changes any more, starting from what the last two steps extrapolate to. The
   * step is thereby implicit in everything, and of the time scheme's order.
   */
  class AlloySolver : public NonlinearSolver
  {
  public:
    /** @param exchange null: walls exchange no heat with their surroundings
     * @throws cases::Refusal for what is not simulated, cases::InputError for
     * concentrations outside of 0 <= C < 1 */
    AlloySolver(const cases::Scene &scene, const cases::EffectSet &effects,
                const Discretisation &mesh, const std::vector<char> &free,
                WallExchange *exchange, const LinearSolverMaker &make_linear_solver);

    /** Largest change by a pass (of conductivities over themselves, of solute
     * over the largest) at which a step is coupled. */
    static constexpr double coupling_tolerance = 1e-10;

    /** Enthalpy per volume (J/m^3) of the nodes at the start: point values. */
    std::vector<double> initial_enthalpy() const;

    /** To be called before a step is solved. @param enthalpy of the last step (J/m^3) */
    void begin(const StepFormula &step, const std::vector<double> &enthalpy);

    /** @throws cases::InputError for mush colder than the liquidus is known */
    StepOutcome solve(double c, const std::vector<double> &rhs, int iteration_limit,
                      CompensatedVector &u, std::vector<double> &heat) override;

    /** Whether no concentration of the solved step is negative beyond round-off. */
    bool concentrations_hold() const;

    /** The solved step becomes the state. */
    void accept();

    double temperature_excess(double u) const override
    {
      return u;
    }

    double kirchhoff(double temperature_excess) const override
    {
      return temperature_excess;
    }

    double kirchhoff_at_enthalpy(std::size_t node, double enthalpy) const override
    {
      return graph.excess_at_enthalpy(enthalpy, composition[node]);
    }

    /** Enthalpy (J/m^3) of a node at a prescribed t; on a jump, the nearest to the last.
     */
    double enthalpy_at(std::size_t node, double excess, double last) const;

    /** Temperature and liquid fraction of a node with an enthalpy (J/m^3). */
    cases::PhaseState state(std::size_t node, double enthalpy) const;

    /** The stiffness matrix with the conductivities of the last pass. */
    const ConductionMatrix &conduction_matrix() const
    {
      return conduction ? conduction->matrix() : uniform_conduction;
    }

    /**
     * The bounds of the maximum principle for an alloy. Where solute diffuses, mush may
     * become colder than anything was, but not colder than the liquidus of the largest
     * concentration at hand: where mush is coldest its liquid is richest, solute leaves,
     * heat comes in, and both warm it.
     */
    cases::TemperatureBounds bounds(cases::TemperatureBounds of_scene) const;

    /** Fill what a snapshot says of substances; sites share nodes as in the mesh. */
    void report(cases::Snapshot &snapshot);

    long work() const override;
    GraphCost graph_cost() const override;

    /** Newton's iterations since the start. */
    long iterations() const
    {
      return all_iterations;
    }

    /** What an effect cost, of those that are simulated here. */
    std::optional<cases::EffectCost> cost(cases::Effect effect) const;

  private:
    struct Substance
    {
      std::size_t index; ///< in the alloy
      double weight;     ///< of C in what a Liquidus measures
      double diffusivity;
      std::vector<double> now;          ///< C by node
      std::vector<double> before, next; ///< the same, empty if it does not diffuse
      double initial_mass;
      std::vector<double> at_sites;

      bool diffuses() const
      {
        return diffusivity > 0;
      }
      const std::vector<double> &in_use() const
      {
        return diffuses() ? next : now;
      }
    };

    void place_solutes();
    void mix();
    double renew_conduction(const CompensatedVector &u, bool first);
    double diffuse(double c);
    void gather(Eigen::VectorXd &amounts) const;
    void accelerate();
    void check_known(const CompensatedVector &u) const;
    void melt(const CompensatedVector &u, const std::vector<double> &heat);
    double mass_of(const Substance &substance) const;

    const cases::Scene &scene;
    const Discretisation &mesh;
    const std::vector<char> &free;
    MushGraph graph;
    double density;
    std::vector<Substance> substances;
    std::vector<Composition> composition;     ///< by node, in use
    std::optional<MushConduction> conduction; ///< where the phases conduct differently
    ConductionMatrix uniform_conduction;      ///< else
    std::optional<SoluteDiffusion> diffusion;
    std::vector<double> liquid;        ///< mass fraction by node, where solute diffuses
    std::vector<double> supply, fixed; ///< work space of diffusion
    std::optional<AndersonMixing> mixing;
    Eigen::VectorXd used,
        found; ///< by a pass: weight times C of the solutes that diffuse
    std::unique_ptr<LinearSolver> linear_solver;
    std::unique_ptr<MushSolver> newton;
    StepFormula step;
    const std::vector<double> *last_enthalpy = nullptr;
    long all_iterations = 0;
    cases::EffectCost solute_cost{cases::Effect::solute};
  };

  /** Whether a scene holds solute, so that it needs an AlloySolver. */
  bool holds_solute(const cases::Scene &scene, const cases::EffectSet &effects);
} // namespace meltfront::reference_fem

#endif
