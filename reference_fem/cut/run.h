#ifndef meltfront_reference_fem_cut_run_h
#define meltfront_reference_fem_cut_run_h

#include <cases/run.h>
#include <cases/scene.h>
#include <reference_fem/cut/heat_problem.h>
#include <reference_fem/cut/options.h>
#include <reference_fem/cut/sites.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::reference_fem::cut
{
  inline constexpr const char *method_name = "fem-cut";

  /** A run of `fem-cut`: start, time steps, snapshots. */
  class CutRun : public cases::Run
  {
  public:
    CutRun(const cases::Scene &scene, const cases::EffectSet &effects,
           const cases::Resolution &resolution);

    // In run_report.cc:
    cases::RunDescription describe() const override;
    cases::Cost cost() const override;

  private:
    void take_steps() override;
    cases::Snapshot snapshot(long step, double time) override; // in run_report.cc
    std::shared_ptr<const BackgroundMesh> make_mesh(const RefinementCriterion &divided,
                                                    const BackgroundMesh *rim) const;
    void start();
    void require_resolved() const;
    void step();
    double next_stop() const;
    double next_step() const;
    double damping_step() const;
    void damp_jump(const std::function<double(const WallPoint &)> &before, double time);
    double datum(const WallPoint &wall, double given) const;
    double worth(const cases::Boundary &boundary, double datum) const;
    std::array<double, 2> depths(const State &of) const;
    bool attempt(double step, bool last_chance, State &next);
    Values moved_front(double step, const SpeedField &end_speed, bool &limited) const;
    Values predicted_front(double step, bool &limited) const;
    Values displaced(const Values &displacement, const std::vector<char> &band,
                     bool &limited) const;
    void accept(State next);
    void follow_front();
    void check(const State &state) const;

    struct VertexValue
    {
      Point point; ///< the nearest of the rim where the vertex lies beyond it
      bool solid;
      double temperature;
    };

    VertexValue at_vertex(const State &of, unsigned int number,
                          unsigned int vertex) const;
    template <typename Visit>
    void visit_vertices(const State &of, bool rim, const Visit &visit) const;
    double corner_jump(double time) const;
    std::string why_last_body_is_lost(const State &checked) const;
    std::string why_beyond_bounds(const State &checked) const;
    double overshoot(const State &of) const;
    double tolerated_overshoot() const;

    /** @return the length of the step that is made, which may become shorter */
    double shorten_to_bounds(double step, State &next);

    void report_initial();
    void collect_sites();
    void add_vertices();
    std::vector<cases::EffectCost> effect_costs() const;
    std::map<std::string, double> evidence() const;

    const cases::Scene &scene;
    const cases::EffectSet &effects;
    const cases::Resolution &resolution;
    RunOptions options;
    std::shared_ptr<const BackgroundMesh> finest_rim; ///< none for boxes
    State state;
    HeatProblem heat;
    cases::TemperatureBounds bounds;
    std::vector<double> breakpoints; ///< of the scene (s)
    std::vector<double> step_ends;   ///< cases::step_ends()
    std::string start_in_words;
    long unknowns_at_start = 0;

    std::optional<State> older;
    double last_step = 0;
    bool fresh = true;         ///< no step was made since the start or a breakpoint
    int damped_steps = 0;      ///< still to be made, after a jump of the data
    double wall_jump = 0;      ///< largest of a wall's datum, while its layer is thin (K)
    double layer_resolved = 0; ///< when that layer is as thick as a cell, h^2/alpha (s)
    long step_number = 0, halved_steps = 0, capped_steps = 0, euler_steps = 0, meshes = 1;
    double boundary_heat = 0, released_heat = 0, initial_heat = 0;

    Sites sites;
  };
} // namespace meltfront::reference_fem::cut

#endif
