#ifndef meltfront_reference_fem_cut_conservative_conservative_run_h
#define meltfront_reference_fem_cut_conservative_conservative_run_h

#include <cases/error.h>
#include <cases/exact/front_start.h>
#include <cases/run.h>
#include <cases/scene.h>
#include <reference_fem/cut/conservative/appearance.h>
#include <reference_fem/cut/conservative/enthalpy_start.h>
#include <reference_fem/cut/conservative/stage.h>
#include <reference_fem/cut/options.h>
#include <reference_fem/cut/sites.h>

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** Spacings from the front up to which the level set is a distance. */
  inline constexpr double reach_of_distance = 6;

  /** A run of `fem-cut` with `scheme = conservative`: start, steps, events, snapshots. */
  class ConservativeRun : public cases::Run
  {
  public:
    /** @throws cases::Refusal for options and starts that the scheme does not know */
    ConservativeRun(const cases::Scene &scene, const cases::EffectSet &effects,
                    const cases::Resolution &resolution);

    // In conservative_report.cc:
    cases::RunDescription describe() const override;
    cases::Cost cost() const override;

  private:
    void take_steps() override;
    cases::Snapshot snapshot(long step, double time) override;

    // In conservative_start.cc:
    void start();
    void start_from(const cases::FrontStart &found);
    void settle_temperatures();
    double fastest_diffusivity() const;
    bool layer_appears_at_once(const cases::FrontStart &found) const;
    bool starts_with_jumps() const;
    void
    damp_jump_at_start(const std::function<double(const cases::Position &)> &temperature);
    void damp_jump_after_step(double began);
    void damp_jump(
        const std::function<double(const WallPiece &, const cases::Boundary &)> &before,
        double after);
    double damping_step() const;
    void run_enthalpy();
    void take_over(const cases::Snapshot &snapshot);
    void take_over_temperatures(const cases::Snapshot &snapshot);
    void even_out(const StepFrame &frame);
    void initial_temperatures(
        const StepFrame &frame,
        const std::function<double(const cases::Position &)> &temperature);
    void require_resolved(const Front &front) const;
    void report_uniform_start();

    // In conservative_bounds.cc:
    void check();
    std::pair<double, double> extremes() const;
    void refuse_if_unresolved(const cases::NumericalError &error) const;
    std::string why_last_body_is_lost() const;
    std::string why_layer_is_lost() const;
    std::string why_jump_overshoots() const;

    void step();
    void make_step();
    double next_step() const;
    struct Step;
    StageData from_state(const StepFrame &frame, StageTime stage, double duration) const;
    StageResult solve(const StepFrame &frame, const StageData &data);
    void make_stages(const StepFrame &frame, double duration, double end, Step &step);
    void make_damped_stage(const StepFrame &frame, double duration, double end,
                           Step &step);
    bool attempt(double duration, double end, Step &step);
    void accept(Step &step, double duration, double end);
    void turn_small_bodies();
    void restore_slopes();
    void let_phases_appear();
    void melt_what_appeared(const Values &before);
    double tolerated_excess() const;
    std::array<double, 2> tolerated_heat() const;
    bool misses_a_phase(const Step &step) const;
    void begin_anew();
    void settle_hats();
    double latent_heat_of_volume() const;
    double domain_area() const;
    double stored_heat() const;
    double latent_heat() const;
    Point in_domain(const Point &point) const;
    Phase phase_at(unsigned int triangle, const Point &point) const;
    unsigned int add_site(unsigned int triangle, const Point &point, double weight,
                          Phase phase, double missed);
    double shown_temperature(unsigned int triangle, const Point &place, Phase phase,
                             double missed) const;
    void collect_sites();
    std::vector<cases::EffectCost> effect_costs() const;

    const cases::Scene &scene;
    const cases::EffectSet &effects;
    const cases::Resolution &resolution;
    const RunOptions options;
    const TriangleMesh mesh;
    const LineSources sources;
    PhaseAssembly assembly;
    const cases::TemperatureBounds bounds;
    const std::vector<double> step_ends; ///< cases::step_ends()
    const AppearanceSetting appearance;
    std::string start_in_words;

    std::optional<EnthalpyStart> before; ///< what the run starts with, if it needs it
    const cases::Snapshot *state_before = nullptr; ///< the state that it has reached
    cases::Cost cost_before;

    double time = 0;
    FrontState state;
    Temperatures temperatures;
    std::vector<double> powers; ///< of line sources at the state
    Values increment;           ///< of the level set in the last step (m)
    double last_step = 0, front_speed = 0;
    double boundary_heat = 0, source_heat = 0, initial_heat = 0;
    long step_number = 0, halved_steps = 0, turned_bodies = 0, appeared_bodies = 0,
         restored_slopes = 0, euler_steps = 0;
    int hard_steps = 0;   ///< in a row, each halved often
    int damped_steps = 0; ///< still to be made, after a jump of the data
    double layer_resolved
        = std::numeric_limits<double>::lowest(); ///< when its layer is as thick as a cell
    long solves = 0, most_solves = 0, unsettled_stages = 0, unknowns = 0,
         most_unknowns = 0, entries = 0;
    double largest_debt = 0; ///< of the solid's area (m^2)

    Sites sites;
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
