#ifndef meltfront_particles_rkpm_tracked_plane_run_h
#define meltfront_particles_rkpm_tracked_plane_run_h

#include <cases/run.h>
#include <particles/rkpm_tracked/plane/heat.h>
#include <particles/rkpm_tracked/plane/marked_front.h>
#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/particle_start.h>
#include <particles/rkpm_tracked/plane/relax.h>
#include <particles/rkpm_tracked/plane/topology.h>
#include <particles/rkpm_tracked/tracking_options.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  class EnthalpyParticles;

  /** Bodies that went at once because they were too small. */
  struct VanishedBodies
  {
    double time = 0;
    double area = 0; ///< m^2
    double rate = 0; ///< at which it shrank (m^2/s)
  };

  /** A run of `rkpm-tracked` in the plane: start, time steps, events, snapshots. */
  class PlaneRun : public cases::Run
  {
  public:
    PlaneRun(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution);

    // In plane_report.cc:
    cases::RunDescription describe() const override;
    cases::Cost cost() const override;

  private:
    void take_steps() override;
    cases::Snapshot snapshot(long step, double time) override; // in plane_report.cc
    // In start.cc:
    void start();
    void start_from_front();
    void lay_front(const PlaneLevelSet &level_set);
    void run_particles();
    void take_over(const cases::Snapshot &snapshot);
    void fit_solid(const EnthalpyParticles &particles);
    void take_temperatures(const EnthalpyParticles &particles);

    void balance_seed();
    void step();
    double next_stop() const;
    double next_step() const;
    double attempt(double step, PlaneState &next);
    void predict(double step, PlaneState &next) const;
    bool move(const std::vector<double> &displacement, PlaneState &next,
              double &largest) const;
    void accept(PlaneState next);
    void relax_nodes();
    bool balance(const PlaneStep &times, const PlaneSolution &solution, PlaneState &next,
                 std::optional<double> &response, bool last_pass, double &largest);
    double lost_heat(const PlaneState &of) const;
    void prepare();
    void follow_level_set();
    void follow_topology();
    TopologySettings topology_settings() const;
    void warn_of_ripples();
    void settle_nodes();
    double vanished_area() const;
    double beyond_melting(const PlaneState &of, std::size_t node) const;
    void check_walls(const PlaneState &checked, double scale) const;
    void check_release(const PlaneState &checked, double scale) const;
    void check(const PlaneState &checked) const;
    void check_resolved() const;
    std::string unresolved_phase() const;

    void report();
    void report_initial();
    std::vector<cases::EffectCost> effect_costs() const;
    std::map<std::string, double> evidence() const;
    /** A step is done when no particle has farther to move, in spacings: the move itself
     * is made, and what it leaves is smaller by about its square. */
    static constexpr double done = 1e-4;

    /** @return the length of the step that is made, which may become shorter */
    double shorten_to_bounds(double step, PlaneState &next);
    double overshoot(const PlaneState &of) const;
    double tolerated_overshoot() const;

    const cases::Scene &scene;
    const cases::EffectSet &effects;
    const cases::Resolution &resolution;
    TrackingParameters parameters;
    PlaneNodes nodes;
    PlaneHeat heat;
    PlaneRelaxation relaxation;
    MarkedFront marked;
    cases::TemperatureBounds bounds;
    std::vector<double> breakpoints; ///< of the scene (s)
    std::vector<double> step_ends;   ///< cases::step_ends()
    std::string start_in_words;
    std::size_t front_at_start = 0; ///< particles
    PlaneState state;
    std::optional<PlaneState> older;
    std::optional<ParticleStart> before; ///< where one phase fills the domain
    cases::Cost cost_before;
    const cases::Snapshot *state_before = nullptr; ///< the state that it has reached
    double last_step = 0;
    bool warned_of_ripples = false;
    bool restarted = true; ///< no step was made since the start or an event
    long step_number = 0, halved_steps = 0, capped_steps = 0, most_passes = 0;
    long next_meeting = 0;
    double initial_heat = 0, condition = 0;
    double handed_over_heat = 0; ///< by which the first method's front and temperatures
                                 ///< are off as they are taken over (J/m)
    double unbooked_heat = 0;    ///< by which start and events are off in the book (J/m)
    double largest_multiplier = 0;
    double withstood = 0; ///< beyond the melting temperature, by phases at the start (K)
    double decreed_heat = 0; ///< latent, of areas that changed phase by decree (J/m)
    std::vector<VanishedBodies> vanished;
    double mismatch = 0; ///< largest of level set and particles, in spacings
    std::vector<std::pair<double, std::string>> events; ///< not yet told

    // For snapshots:
    PlaneMeasure measured;
    std::array<std::vector<double>, 2> site_positions, front_positions;
  };

  /** @throws cases::Refusal for a scene that is not treated. */
  std::unique_ptr<cases::Run> make_plane_run(const cases::Scene &scene,
                                             const cases::EffectSet &effects,
                                             const cases::Resolution &resolution);
} // namespace meltfront::particles::rkpm_tracked

#endif
