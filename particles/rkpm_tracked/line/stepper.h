#ifndef meltfront_particles_rkpm_tracked_line_stepper_h
#define meltfront_particles_rkpm_tracked_line_stepper_h

#include <particles/rkpm_tracked/line/events.h>
#include <particles/rkpm_tracked/line/solver.h>

#include <functional>
#include <limits>
#include <string>

namespace meltfront::particles::rkpm_tracked
{
  /** Bounds on the steps that a stepper takes. */
  struct StepRules
  {
    double cfl = 0.5;            ///< of a front in a step, over the spacing
    double first_step = 0;       ///< after a start without history and after events (s)
    double temperature_span = 1; ///< that events are found to a share of (K)
    double shortest_step = 0;    ///< a step that must be shorter fails (s)
    /** Longest step over the time since a start or an event, once that is as long that
     * planned steps may be taken; earlier it may be longer, as less heat is at stake: by
     * the fourth root of the age each octave of it errs alike where heat comes in like
     * the root of the time. */
    double share_of_age = std::numeric_limits<double>::infinity();
    double planned_step = 0; ///< s
    /** Of a thin layer in a step, over its thickness; with a share of the age thinner
     * ones grow faster, by the root of the thickness. */
    double layer_growth = 0.1;
    cases::TemperatureBounds bounds{}; ///< of all temperatures (K)
    /** A step of a formula of high order that is long beside the time in which a phase
     * evens out overshoots, whatever the spacing: it is made anew with half its length
     * where temperatures pass their bounds, or a phase its melting temperature, by more
     * than this and more than before (K). */
    double largest_overshoot = std::numeric_limits<double>::infinity();
  };

  /**
   * Takes a line problem from time to time in steps of its own choice: shorter where a
   * front is fast, after a start and after events. Phases appear at walls that pass the
   * melting temperature, vanish where their fronts reach a wall, and fronts that meet
   * take the phase between them away.
   */
  class LineStepper
  {
  public:
    using Note = std::function<void(double time, const std::string &event)>;
    using AfterStep = std::function<void(const LineState &begin)>;

    LineStepper(const LineProblem &problem, const LineSettings &settings,
                const StepRules &rules, Note note);

    /** Begin from a state; a phase that a wall calls for at once appears.
     * @param older states before it, newest first, equally far apart */
    void start(LineState state, std::vector<LineState> older);

    /** Give the walls of a state the temperatures that they have from its time on.
     * @return heat content that this changed by the walls' nodes */
    double set_walls(LineState &changed);

    /** Begin anew from the state at hand, at a time at which what walls prescribe jumps
     * or bends: without history, with the walls' temperatures from then on.
     * @return heat content that this changed by the walls' nodes */
    double begin_anew();

    /**
     * Advance to a time, reached exactly.
     * @param after_step called after every step that is kept, with the state in which it
     * began: after an event not the one in which the last ended
     * @throws cases::NumericalError where steps would have to be too short or a value is
     * not finite
     */
    void advance(double target, const AfterStep &after_step);

    /** See LineSolver; to be called after a step that was kept. */
    void nodes_moved(std::span<const double> before, std::deque<LineState> states)
    {
      solver.nodes_moved(before, std::move(states));
    }

    const LineState &state() const
    {
      return solver.state();
    }

    const LineSolver &line_solver() const
    {
      return solver;
    }

    /** Steps kept. */
    long steps() const
    {
      return kept;
    }

    /** Where and how a thermal layer beside a front was thinner than a spacing; empty:
     * none was, but those that had just appeared. */
    const std::string &unresolved_layer() const
    {
      return unresolved;
    }

    /** Steps that were cut short. */
    long shortened() const
    {
      return shortened_steps;
    }

  private:
    double choose_end(double target) const;
    void shorten(StepOutcome outcome, double time_step);
    double growth_of_layer(double thickness) const;
    bool vanishes_too_fast(const LineState &before) const;
    bool gone_at_centre() const;
    bool a_front_turned(const std::deque<LineState> &before) const;
    /** The step once more, of first order: where a layer beside it is not resolved a
     * front halts before each node, and formulas that look back run past that place. */
    void step_without_history(const LineState &before, double end);
    bool pass_wall(const std::deque<LineState> &before, double time_step);
    double shorten_to_bounds(const std::deque<LineState> &before, double time_step);
    void insert(std::size_t side);
    void insert_where_called_for();
    void remove(std::size_t number);
    void restart(LineState state);
    void warn_of_thin_layers();
    void warn_of_metastable_phases();

    const LineProblem &problem;
    LineSolver solver;
    StepRules rules;
    Note note;
    double next_step;             ///< the longest that may come next (s)
    double begun = 0;             ///< time of the last start or event (s)
    double growth;                ///< of steps from one to the next
    std::array<double, 2> wanted; ///< excess at which a layer appears at a wall (K)
    long kept = 0;
    long shortened_steps = 0;
    long events = 0;
    std::array<int, 2> warned{}; ///< of liquid and solid: how strongly
    std::string unresolved;
    std::array<bool, 2> warned_metastable{};
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
