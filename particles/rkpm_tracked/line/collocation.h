#ifndef meltfront_particles_rkpm_tracked_line_collocation_h
#define meltfront_particles_rkpm_tracked_line_collocation_h

#include <cases/effect_meter.h>
#include <particles/rkpm_tracked/line/band_matrix.h>
#include <particles/rkpm_tracked/line/problem.h>
#include <particles/rkpm_tracked/line/stencils.h>

#include <span>

namespace meltfront::particles::rkpm_tracked
{
  /** A phase between two ends, each of them a front or a wall. */
  struct LineInterval
  {
    double lower = 0, upper = 0; ///< m
    bool lower_front = false, upper_front = false;
    bool solid = false;
  };

  /** An interval of a state. */
  LineInterval interval(const LineProblem &problem, const LineState &state,
                        std::size_t number);

  /** What an implicit step adds to the equation of conduction: leading T + history = a
   * (T_xx + ...) - u T_x + f/(rho c). */
  struct StepTerms
  {
    double time = 0;                 ///< at which the equation holds (s)
    double leading = 0;              ///< 1/s
    std::span<const double> history; ///< of each node (K/s)
    double displaced_speed = 0;      ///< u at the front that displaces matter (m/s)
    double displacing_front = 0;     ///< its place (m)
    /** Speeds at which fronts at the lower and the upper end move into the phase (m/s); 0
     * where none does, or where its layer is not to be fitted. */
    std::array<double, 2> approach{};
    std::array<double, 2> rate{}; ///< of fronts at the lower and the upper end (m/s)
    std::array<double, 2> given_flux{}; ///< by walls that give one (W/m^2)
  };

  /** Slopes of the temperature at the two ends of an interval (K/m). */
  using EndSlopes = std::array<double, 2>;

  /** Collocates the conduction of heat in one phase at a time. */
  class LineCollocation
  {
  public:
    LineCollocation(const LineProblem &problem, const LineSettings &settings);

    /**
     * Temperature of an interval at the end of an implicit step.
     * @param temperature at all nodes; those of the interval are written
     * @return slopes at the ends
     */
    EndSlopes solve(const LineInterval &interval, const StepTerms &terms,
                    std::span<double> temperature);

    /** Slopes at the ends of an interval for given temperatures. */
    EndSlopes slopes(const LineInterval &interval, std::span<const double> temperature);

    /** From now on nodes that are near a front go on being interpolated or not, as they
     * were last, or none does so: a front at which one would change that has no place. */
    void keep_points(bool keep)
    {
      kept = keep;
    }

    /** From now on the liquid and the solid (true) hold a layer that is thinner than a
     * cell. Where rows are balances slopes in such a phase are straight, and none of its
     * nodes is left out. */
    void set_steep(std::array<bool, 2> phases)
    {
      steep = phases;
    }

    /** Whether a phase that was solved for is all between a wall of given temperature and
     * a front, without a node inside. */
    bool is_held_film(const LineInterval &interval) const;

    /** Measure the cells of an interval without a solve, of all nodes: what the
     * temperatures hold, whatever these are. */
    void measure_cells_of(const LineInterval &interval);

    /** What flows through any cut of the phase that was solved for, of a moving phase,
     * over its diffusivity: in the measure of the scene, u A/a. */
    double flow() const
    {
      return displaced_flow;
    }

    /** What the nodes of the interval stand for that was solved for or measured; those
     * that are interpolated for nothing.
     * @param cells of all nodes; those of the interval are written */
    void write_cells(std::span<double> cells) const;

    /** Temperature of a wall (0: lower, 1: upper) beside an interval that exchanges heat
     * with its surroundings, of an ambient temperature, for given temperatures of the
     * other nodes. */
    double exchanging_wall(const LineInterval &interval, std::size_t side, double ambient,
                           std::span<const double> temperature);

    /** Nodes strictly inside an interval or on a wall that bounds it, [first, end);
     * `absorbed` counts those that lie too near to a front. */
    std::pair<std::size_t, std::size_t> nodes_of(const LineInterval &interval) const;

    /** The problem's nodes have moved: weights among them are made anew where a node
     * moved in their reach.
     * @param before where they were */
    void nodes_moved(std::span<const double> before);

    /** Matrix entries so far. */
    long work() const
    {
      return entries;
    }

    /** What walls of a kind and heat that is released have cost; null for an effect that
     * is a factor of all rows. */
    const cases::EffectMeter *meter(cases::Effect effect) const;

  private:
    /**
     * Heat released beside a front that no node sees: where what is released jumps
     * between the front and the first node, its excess there over what the nodes beyond
     * continue to the front. Nodes then hold T + D (X + s - x)^2/(2 k), smooth up to the
     * front, and the slope at the front is D s/k beside theirs. Without it the heat would
     * change its density where the front is found to be and not where it is said to, and
     * errors of the front would grow by exp(int D/(rho L) dt). Where the density is
     * smooth, D is of second order.
     */
    struct UnseenRelease
    {
      double density = 0; ///< D, W/m^3
      double reach = 0;   ///< s from the front on, m
      double seen = 0;    ///< what the nodes continue to the front's cell, W/m^3
    };

    UnseenRelease unseen_release(std::size_t side, double time) const;
    bool is_steep(const LineInterval &interval) const;
    double distance_left_out(const LineInterval &interval) const;
    void gather(const LineInterval &interval, double left_out_within);
    void make_regular_faces();
    void evaluate_stencil(double place, LineStencil &stencil);
    void evaluate_face(double place, LineStencil &stencil);
    const LineStencil &stencil(std::size_t point);
    void add_row(std::size_t point, const LineInterval &interval, const StepTerms &terms);
    void add_wall_row(std::size_t point, int side, const LineInterval &interval,
                      const StepTerms &terms);
    void add_wall_heat(std::size_t point, const LineInterval &interval,
                       const StepTerms &terms);
    void face_stencil(std::size_t point);
    void find_faces(const LineInterval &interval, const StepTerms &terms);
    void hasten(LineStencil &face, double distance, double next,
                const LineInterval &interval, const StepTerms &terms) const;
    void measure_cells();
    const LineStencil &balance(std::size_t point);
    void find_shares_of_faces(const LineInterval &interval, const StepTerms &terms);
    double excess_at_face(std::size_t face, std::span<const double> values) const;
    double face_slope(std::size_t face, std::span<const double> values) const;
    double balanced_front_slope(std::size_t side, bool solid,
                                std::span<const double> values) const;
    double balanced_wall_slope(std::size_t side, bool solid, const StepTerms &terms,
                               std::span<const double> values) const;
    EndSlopes balanced_slopes(const LineInterval &interval, const StepTerms &terms) const;
    void add_release(const LineInterval &interval, double time);
    void make_rows(const LineInterval &interval, const StepTerms &terms);
    void fill_matrix();
    bool walls_settled(const LineInterval &interval);
    void interpolate_absorbed(const LineInterval &interval,
                              std::span<double> temperature) const;
    void gather_values(const LineInterval &interval, std::span<const double> temperature);
    EndSlopes end_slopes() const;
    double slope_over_resolved(const LineInterval &interval, std::size_t side,
                               double approach) const;

    const LineProblem &problem;
    double interpolation_distance; ///< over the spacing
    double dilation;               ///< over the spacing
    LineStencils stencils;
    std::vector<LineStencil> regular;       ///< of each node among all nodes
    std::vector<LineStencil> regular_faces; ///< half-way to the next node, where balanced
    std::size_t all_first = 0, all_end = 0; ///< nodes of the interval
    std::size_t first = 0, end = 0;         ///< those that are collocated
    bool kept = false;                      ///< nodes are as they were last
    std::array<bool, 2> steep{};            ///< liquid, solid
    std::vector<bool> interpolated;         ///< nodes, last
    std::size_t offset = 0;                 ///< of node `first` in the cloud
    ParticleStorage cloud;
    std::vector<LineStencil> rows;  ///< of the cloud's points
    std::vector<LineStencil> faces; ///< half-way to the next point, where balanced
    std::vector<double> volumes;    ///< of the points' cells, where balanced
    double displaced_flow = 0;      ///< see flow()
    /** Where a phase moves, what the point below a face counts for in the temperature of
     * what flows through it. */
    std::vector<double> share_below;
    std::vector<std::vector<double>> coefficients;
    std::vector<double> right_side;
    BandMatrix matrix;
    /** Newton's passes for walls that radiate: few are needed. */
    static constexpr int most_passes = 20;
    std::array<double, 2> wall_guess{}; ///< about which radiation is linearised (K)
    long entries = 0;
    std::array<UnseenRelease, 2> unseen{}; ///< at the lower and the upper front
    cases::EffectMeter release;
    std::array<cases::EffectMeter, cases::n_boundary_kinds> walls;
  };

  /** Nodes and fronts that lie nearer to each other than this coincide (over the
   * spacing). */
  inline constexpr double coincidence = 1e-9;
} // namespace meltfront::particles::rkpm_tracked

#endif
