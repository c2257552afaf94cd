#ifndef meltfront_reference_fem_cut_heat_problem_h
#define meltfront_reference_fem_cut_heat_problem_h

#include <cases/effect_meter.h>
#include <cases/time_integral.h>
#include <cases/wall_law.h>
#include <reference_fem/cut/front_speed.h>
#include <reference_fem/cut/phase_problem.h>
#include <reference_fem/cut/released_heat.h>
#include <reference_fem/cut/sink_field.h>

#include <array>
#include <memory>
#include <vector>

namespace meltfront::reference_fem::cut
{
  /**
   * A front and the temperatures on both sides of it at a time. In the solid the unknown
   * is T - S (SinkField), in the liquid T; both reach beyond their phase.
   */
  struct State
  {
    double time = 0;
    std::shared_ptr<const BackgroundMesh> mesh;
    Values level_set; ///< signed distance, negative in the solid (m)
    std::shared_ptr<const CutGeometry> geometry;
    std::array<Values, 2> unknown; ///< by Phase
    SpeedField speed;
    /** Heat in through the walls (W/m); where walls' fluxes vary, without these. */
    double wall_power = 0;
    double flux_heat = 0; ///< what walls' varying fluxes brought in the last step (J/m)
    double released_heat = 0; ///< throughout the domain in the last step (J/m)
  };

  /** Factors of a time derivative: d/dt u = now u + before u_before + older u_older. */
  struct TimeDerivative
  {
    double now, before, older;
  };

  /** BDF2 for steps of any ratio; backward Euler without a step before. */
  TimeDerivative time_derivative(double step, double step_before);

  /** What the parts of a solve cost that effects call for. */
  struct CutMeters
  {
    cases::EffectMeter front, sinks, released;
    std::array<cases::EffectMeter, cases::n_boundary_kinds> walls;
  };

  /** Heat conduction on both sides of a given front, and the speed that follows. */
  class HeatProblem
  {
  public:
    /** @param spacing of the finest cells (m) */
    HeatProblem(const cases::Scene &scene, double spacing,
                const Stabilisation &stabilisation, double smoothing);

    /** Geometry of a front; the level set becomes a distance beside it. */
    void set_front(State &state, Values level_set) const;

    /**
     * Temperatures of a function, as their Ritz projection: it has the accuracy of the
     * discretisation also in the heat that flows to the front, and so gives the speed.
     */
    void project(State &state, const PointFunction &temperature);

    /** Temperatures, speed and wall power at state.time for the front of the state; all
     * states on one mesh. */
    void solve(State &state, const State &before, const State *older);

    /** The same state on another mesh, whose cells at the front are those of its own. */
    State transferred(const State &state,
                      std::shared_ptr<const BackgroundMesh> mesh) const;

    /** Temperature of a phase at a point of a cell. */
    double temperature(const State &state, Phase phase, unsigned int cell,
                       const Point &unit) const;

    /** Sensible heat, integral of rho c (T - T_m) (J/m). */
    double sensible_heat(const State &state) const;

    /** Latent heat of the liquid (J/m). */
    double latent_heat(const State &state) const;

    /** What an effect has cost so far, a state given for its arrays. Two conductivities
     * or capacities in place of one are other numbers in the same matrices, with no time
     * of their own. */
    cases::EffectCost cost(cases::Effect effect, const State &state) const;

    /** Whether a point lies in the solid and not at its front. */
    bool in_solid(const State &state, const Point &point) const;

    SinkField sinks;
    long solves = 0, unknowns = 0; ///< unknowns of the last solve, both phases
    long most_unknowns = 0;        ///< of any solve
    long entries = 0;              ///< of matrices, over all solves
    mutable CutMeters meters;

  private:
    double sink_value(const Point &point, double time) const;
    const cases::PhaseProperties &properties(Phase phase) const;
    Values values_on_front(const BackgroundMesh &mesh,
                           const PhaseEquation &equation) const;
    PhaseEquation projection(Phase phase, const State &state,
                             const PointFunction &temperature) const;
    Gradient gradient_beside_front(const PointFunction &function, Phase phase,
                                   const State &state, const Cell &cell,
                                   const Point &unit) const;
    void find_speed(State &state, const std::array<std::vector<double>, 2> &flux) const;
    /** @param before, older null where the conditions are those of a time */
    PhaseEquation conditions(Phase phase, const State &state, const State *before,
                             const State *older) const;
    double flux_in(cases::Side side, const cases::Position &position, const State &state,
                   const State *before, const State *older) const;
    cases::HeatThroughWall exchange(const WallPoint &wall, Phase phase,
                                    const State &state, const State *before) const;
    double flux_power(const State &state, const State &before, const State *older) const;
    PointFunction source(Phase phase, const State &state, const State &before,
                         const State *older) const;
    double heat_released(const State &state, const State &before) const;
    PhaseEquation equation(Phase phase, const State &state, const State &before,
                           const State *older) const;
    PointFunction change_of_sinks(const TimeDerivative &derivative, const State &state,
                                  const State &before, const State *older) const;
    double sink_wall_power(const State &state) const;

    const cases::Scene &scene;
    const double spacing;
    const Stabilisation &stabilisation;
    double smoothing;
    std::array<std::optional<cases::TimeMean>, cases::n_sides> fluxes; ///< of walls
    bool fluxes_vary = false;
    mutable std::optional<ReleasedHeat> released;
  };
} // namespace meltfront::reference_fem::cut

#endif
