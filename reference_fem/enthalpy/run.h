#ifndef meltfront_reference_fem_enthalpy_run_h
#define meltfront_reference_fem_enthalpy_run_h

#include <cases/run.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/alloy_solver.h>
#include <reference_fem/enthalpy/front_conduction.h>
#include <reference_fem/enthalpy/front_refinement.h>
#include <reference_fem/enthalpy/heat_sources.h>
#include <reference_fem/enthalpy/liquid_motion.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/options.h>
#include <reference_fem/enthalpy/time_scheme.h>
#include <reference_fem/enthalpy/truncated_newton.h>
#include <reference_fem/enthalpy/volumetric_source.h>
#include <reference_fem/enthalpy/wall_flux.h>
#include <reference_fem/enthalpy/wall_temperature.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::reference_fem
{
  /** Worst values over the steps of a run. */
  struct StepStatistics
  {
    double graph_inconsistency = 0; ///< see StepOutcome::graph_inconsistency
    double balance_defect = 0;      ///< of one step, over the heat at hand
    int iterations = 0;
    long halvings = 0;    ///< steps that were halved
    long euler_steps = 0; ///< steps that BDF2 left to backward Euler

    template <class Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &graph_inconsistency &balance_defect &iterations &halvings &euler_steps;
    }
  };

  /** The largest relative defect of a step's heat balance that is accepted. */
  inline constexpr double accepted_balance_defect = 1e-13;

  /** A run: the state and the parts that the scene's effects call for. */
  class EnthalpyRun : public cases::Run
  {
  public:
    EnthalpyRun(const cases::Scene &scene, const cases::EffectSet &effects,
                const cases::Resolution &resolution);

    // In run_report.cc:
    cases::RunDescription describe() const override;
    cases::Cost cost() const override;

    const StepStatistics &worst_of_steps() const
    {
      return statistics;
    }

  private:
    void take_steps() override;
    cases::Snapshot snapshot(long step, double time) override; // in run_report.cc

    // In run_state.cc:
    void save(boost::archive::binary_oarchive &state) const override;
    void restore(boost::archive::binary_iarchive &state) override;
    template <class Archive>
    void pass_state(Archive &state);
    void require_resumable() const;

    /** What a quantity that is summed over time was at the last two times. */
    struct History
    {
      double now = 0, before = 0;

      template <class Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &now &before;
      }
    };

    /** What changes of the mesh, and parts of a run that were left, leave behind. */
    struct Adaptation
    {
      long adaptations = 0;
      double transfer_defect = 0; ///< largest heat lost in one, over the heat at hand
      int steps_since = 0;        ///< the mesh was looked at
      long most_unknowns = 0;
      double unknowns_times_steps = 0;
      long work = 0, linear_iterations = 0; ///< before
      std::vector<cases::EffectCost> effects;

      template <class Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &adaptations &transfer_defect &steps_since &most_unknowns;
        archive &unknowns_times_steps &work &linear_iterations &effects;
      }
    };

    std::string mesh_in_words() const;
    void judge_mesh();
    void make_parts(Mesh &geometry);
    void make_solver();
    StepProblem problem();
    StepFormula formula(double next) const;
    void predict(double next);
    StepOutcome attempt(const StepFormula &step);
    StepOutcome solve_with_fronts(const StepFormula &step);
    void accept(const StepFormula &step);
    double enthalpy_at_wall(unsigned int node, double temperature, double last) const;
    void move_liquid();

    // In run_adaptation.cc:
    void refine_start();
    std::vector<double> state_ahead() const;
    bool refine_for_step();
    void adapt_to_state();
    bool change_mesh(const std::vector<Wish> &wishes);
    void continue_on_new_mesh();
    double least_volume_over_typical() const;
    Adaptation with_costs() const;

    void require_halvable(const StepFormula &step, const StepOutcome &outcome) const;
    StepOutcome solve(StepFormula &step);
    void check_temperatures(const StepFormula &step) const;
    bool keeps_bounds(const StepFormula &step) const;
    double nominal_step() const;
    double total_heat() const;
    void check_balance();
    double source_heat() const;
    double density() const;
    void state_of_sites();
    double latent_heat(std::size_t node) const;
    std::vector<cases::EffectCost> effect_costs() const;

    std::unique_ptr<LiquidMotion> motion; ///< null where no liquid is displaced
    const cases::Scene &scene;            ///< in the coordinate of mass where one is
    const cases::EffectSet &effects;
    const cases::Resolution &resolution;
    RunOptions options;

    std::unique_ptr<RefinableMesh> refinable; ///< null where the mesh stays as it is
    std::optional<FrontRefinement> refinement;
    Adaptation adaptation;

    Discretisation mesh;
    std::vector<char> free;
    std::shared_ptr<const Levels> levels; ///< null where nodes have no coarser ones
    std::unique_ptr<NonlinearSolver> solver;
    AlloySolver *alloy = nullptr;          ///< the solver, where there is solute
    LinearSolver *linear_solver = nullptr; ///< of the pure solver
    std::optional<FrontConduction> fronts;
    std::string linear_solver_in_words;
    std::unique_ptr<Mesh> mesh_of_moving_sources; ///< null where none moves
    std::optional<HeatSources> sources;
    std::optional<VolumetricSource> release;
    std::optional<WallTemperature> walls;
    std::optional<WallFlux> flux;
    std::optional<WallExchange> exchange;
    cases::TemperatureBounds bounds;
    bool obeys_maximum_principle; ///< discretely, whatever the spacing
    double slack;                 ///< of temperatures, over the span of their bounds

    CompensatedVector u, u_accepted, u_before;     ///< by node, W/m
    std::vector<double> enthalpy, enthalpy_before; ///< by node, J/m^3
    std::vector<double> rhs, heat;                 ///< by node, J
    History boundary_heat, released_heat;
    double step_flux_heat = 0;     ///< what the flux walls bring in the step under way
    double step_released_heat = 0; ///< what is released throughout the domain in it
    double initial_heat = 0;
    double defect = 0; ///< heat at hand less heat received (J)
    double time, time_before;
    std::vector<double> breakpoints; ///< of the scene, at which steps end (s)
    StepQueue queue;
    long step_number = 0, iterations = 0, capped_steps = 0;
    StepStatistics statistics;
    std::vector<double> site_temperature, site_solid_fraction;
  };
} // namespace meltfront::reference_fem

#endif
