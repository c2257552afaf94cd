#ifndef meltfront_particles_rkpm_tracked_plane_heat_h
#define meltfront_particles_rkpm_tracked_plane_heat_h

#include <cases/effect_meter.h>
#include <cases/wall_law.h>
#include <particles/rkpm_tracked/plane/sinks.h>
#include <particles/rkpm_tracked/plane/state.h>
#include <particles/scattered/compressed_rows.h>
#include <particles/scattered/given_values.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** How plane phases are collocated. */
  struct PlaneHeatSettings
  {
    int order = 2; ///< of the basis
    double interpolation_distance
        = 0.1;                ///< nodes nearer to the front count as on it, in spacings
    bool solid_beyond = true; ///< whether what no front goes round is solid
    int threads = 1;
    /** Gibbs-Thomson: by how much a unit of the solid's curvature lowers the front's
     * temperature, T_m Gamma (K m). */
    double capillarity = 0;
  };

  /** What the parts of the solver cost that effects call for. */
  struct PlaneMeters
  {
    cases::EffectMeter front, capillarity, sinks, release;
    std::array<cases::EffectMeter, cases::n_boundary_kinds> walls;
  };

  /** What a pass finds: of the nodes' temperatures, then of the ways of the front's
   * particles (in spacings), what they are without the multiplier and their change with
   * it; that is empty where walls hold their temperature. */
  struct PlaneSolution
  {
    std::vector<double> constant, slope;
    /** Heat that a unit of the multiplier gives in the step, about (J/m). */
    double heat = 0;

    std::vector<double> at(double multiplier) const;
  };

  /**
   * A time step by backward differentiation with one or two states before it:
   *
   *   dU/dt = (a U^{n+1} - b U^n + c U^{n-1}) / step.
   */
  struct PlaneStep
  {
    PlaneStep(const PlaneState &last, const PlaneState *older, double time);

    const PlaneState &last;
    const PlaneState *older; ///< null: backward Euler
    double time, step;
    LinearStep span; ///< for what is prescribed
    double a = 1, b = 1, c = 0;
  };

  /**
   * Heat in both phases and the motion of the front, solved together: temperatures at the
   * nodes and by how much each front particle has still to move along its normal. The
   * front's position enters linearised about where it stands; solving again on the moved
   * front is Newton's method, which no stiffness of the front slows.
   *
   * In node i of phase j, with the front particles p at T_p - G_p d_p,
   *
   *   rho c dT/dt = k lap T,     rho L (x_p + d_p n_p - history) . n_p a/step
   *                                = [k_s dT_s/dn - k_l dT_l/dn] at x_p + d_p n_p
   *                                  + mu s_p.
   *
   * Collocation conserves no heat. Where walls hold their temperature what they give is
   * in no row: it is the reaction that the heat balance asks for, and mu is zero. Else mu
   * is the unknown that belongs to one more equation, the heat balance of the step
   * (PlaneRun::balance). It is the share by which all that flows to the front
   * is off.
   */
  class PlaneHeat
  {
  public:
    /** @param scene, nodes outlive the solver */
    PlaneHeat(const cases::Scene &scene, const PlaneNodes &nodes,
              const PlaneHeatSettings &settings);

    /** The nodes have moved: rows that reach to one that did are made anew.
     * @param before where they were */
    void nodes_moved(std::span<const PlanePoint> before);

    /** Tell particles within the domain from those beyond its walls. */
    void mark_active(PlaneFront &front) const;

    /** Put the front of a state to use: active particles, phases of the nodes.
     * @param keep_phases leave the phases as they are: late passes move the front by next
     * to nothing, and nodes would go to and fro */
    void set_front(PlaneState &state, bool keep_phases = false);

    /** Expansions about the front of temperatures that are given at the nodes, and the
     * speeds that they make; for the start and after events (set_front() first). */
    void expand(PlaneState &state);

    /**
     * One pass on the front of `next` (set_front() first).
     * @param next has expansions, of the pass before or of the last state
     * @return nothing where the matrix is singular
     */
    std::optional<PlaneSolution> solve(const PlaneStep &step, PlaneState &next);

    /**
     * Give a state what the last pass has found, for a value of the multiplier.
     * @param next its front is where it was in the pass; temperatures, expansions, speeds
     * and heat are set
     * @return the displacements along the normals that are still to be made (m)
     */
    std::vector<double> apply(const PlaneStep &step, const PlaneSolution &solution,
                              double multiplier, PlaneState &next);

    /** Whether walls hold their temperature: the heat that these give is told by fits,
     * whose errors the front must not make up for. */
    bool walls_hold_temperature() const
    {
      return holds_walls;
    }

    /** Temperature of the front's particles (K), curvature of the state. */
    double front_temperature(double curvature) const;

    /** The same at a node that counts as on the front, by the nearest particle. */
    double front_temperature_near(std::size_t node) const;

    /** Temperature at a node. */
    double temperature(const PlaneState &state, std::size_t node) const;

    /** The sinks' singular part at a node, a mean over its cell beside a sink (K). */
    double singular_part(std::size_t node, double time) const;

    /** Phase at a place, by the front last set. */
    bool solid(const PlanePoint &place) const
    {
      return index->solid(place);
    }
    const FrontIndex &front_index() const
    {
      return *index;
    }

    /** What an effect has cost so far. Two conductivities or capacities in place of one
     * are other numbers in the same rows, with no time of their own. */
    cases::EffectCost cost(cases::Effect effect) const;

    /** Largest condition number of moment matrices at a state's front, the last set. */
    double worst_condition(const PlaneState &state);

    PlaneSinks sinks;
    PlaneHeatSettings settings;
    long entries = 0; ///< of all matrices factorised
    long solves = 0;
    long singular = 0; ///< solves whose matrix was singular
    std::size_t most_unknowns = 0;
    mutable PlaneMeters meters;

  private:
    /** What is collocated at a node: the Laplacian inside; on a wall the outward
     * derivative times the wall's length, less the Laplacian times the node's area. */
    struct Row
    {
      std::vector<std::uint32_t> columns;
      std::vector<double> weights;
      double reach = 0; ///< of a row without the front in it; 0: made anew each pass
    };

    /** Value of a front particle in a phase: constant + slope . displacement of it and
     * its neighbours. */
    struct FrontValue
    {
      double constant;
      double own, before, after;
    };

    const cases::PhaseProperties &properties(NodePhase phase) const;
    void make_rows(const PlaneState &state);
    bool runs_along(const PlaneFront &front, const WallNode &wall) const;
    void make_row(StencilMaker &maker, PlaneStencil &stencil, NodePhase phase,
                  std::size_t node);
    void make_front_stencils(const PlaneState &state);
    void find_front_values(const PlaneState &state);
    void add_capillarity(const PlaneFront &front);
    std::size_t front_bytes() const;
    std::size_t wall_bytes(cases::BoundaryKind kind) const;
    cases::EffectMeter &wall_meter(const WallPiece &piece) const
    {
      return meters.walls[static_cast<std::size_t>(piece.boundary->kind)];
    }
    void add_node(const PlaneStep &step, const PlaneState &next, std::size_t node);
    double known_rate(const PlaneStep &step, NodePhase phase, std::size_t node) const;
    void add_wall(const PlaneStep &step, const PlaneState &next, const WallNode &wall);
    void add_front(const PlaneStep &step, const PlaneState &next, std::size_t particle);
    void find_wall_inflow(const PlaneStep &step, const PlaneState &next);
    double power_through(const PlaneStep &step, const WallPiece &piece,
                         const PlanePoint &place, double own, double guess) const;
    double particle_length(const PlaneFront &front, std::size_t particle) const;
    void spread_multiplier(const PlaneStep &step, const PlaneState &next,
                           PlaneSolution &solution);
    double flow_to_front(const PlaneStep &step, const PlaneState &next,
                         std::size_t particle) const;
    cases::HeatTransfer transfer_through(const WallPiece &piece, double value,
                                         const PlaneState &latest, std::uint32_t node);
    void add(NodePhase phase, std::uint32_t column, double weight);
    void finish_row(double right_hand_side);
    void update_expansions(PlaneState &state, std::span<const double> solution);
    void extrapolate_inactive(PlaneState &state) const;
    double front_value(NodePhase phase, std::size_t particle,
                       std::span<const double> solution) const;
    void add_heat(const PlaneStep &step, double power, PlaneState &next);
    double wall_power(const PlaneStep &step, const PlaneState &state,
                      std::span<const double> solution) const;
    double flux_heat(const PlaneStep &step) const;
    double released_heat(const PlaneStep &step);

    const cases::Scene &scene;
    GivenValues given;
    const PlaneNodes &nodes;
    std::vector<StencilMaker> makers; ///< one for each thread
    std::unique_ptr<FrontIndex> index;
    PlaneBins front_bins;
    std::vector<Row> rows;
    bool holds_walls;
    std::array<std::vector<PlaneStencil>, n_phases> front_stencils;
    std::array<std::vector<FrontValue>, n_phases> front_values;
    /** Areas that the balances of wall nodes are of (m^2): those of the nodes, none where
     * the front is nearer than half a spacing; a film's fits say nothing of second
     * derivatives across it. */
    std::vector<char> beside_films; ///< of wall nodes
    std::vector<double> wall_areas;
    std::vector<double> wall_guesses;       ///< about which radiation is linearised (K)
    std::vector<std::size_t> before, after; ///< neighbours along the curves
    /** Curvature of the circle through a particle and its neighbours: its change with
     * their moves is what the matrix holds, where that of the spline for the shortest
     * ripples is three times as large, and Newton's method then overshoots. */
    std::vector<double> bend;

    CompressedRows matrix;
    std::vector<double> right_side;
    std::vector<double> wall_inflow;           ///< to front particles, at walls (W/m)
    double release_begin = 0, release_end = 0; ///< of the step last asked for (s)
    double released = 0;                       ///< in that (J/m)
    std::vector<double> spread;                ///< of a unit of the multiplier, by row
    std::vector<std::uint32_t> row_columns, scratch;
    std::vector<double> row_values;
    double row_right_side = 0;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
