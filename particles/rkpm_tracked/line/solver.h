#ifndef meltfront_particles_rkpm_tracked_line_solver_h
#define meltfront_particles_rkpm_tracked_line_solver_h

#include <particles/rkpm_tracked/line/history.h>

namespace meltfront::particles::rkpm_tracked
{
  /** What became of a step. */
  enum class StepOutcome
  {
    accepted,
    too_far,       ///< a front would move by more than a spacing
    closing,       ///< a phase would become thinner than the least thickness
    not_converged, ///< the fronts' equations
    not_finite
  };

  /** What the solver has done so far. */
  struct LineCounters
  {
    long steps = 0;
    long evaluations = 0;      ///< solutions of all phases for given fronts
    long most_evaluations = 0; ///< of one step
  };

  /**
   * Implicit steps of temperatures and fronts together: backward differentiation of both,
   * the fronts by Broyden's method (the secant method for one front), each trial with new
   * temperatures of all phases.
   */
  class LineSolver
  {
  public:
    LineSolver(const LineProblem &problem, const LineSettings &settings);

    /** Begin, or begin again after an event, from a state whose speeds need not be set.
     */
    void restart(LineState state);

    /** Give a wall (0: lower, 1: upper) of a state the temperature that it has from its
     * time on: what is prescribed, or what an exchange with an ambient temperature leads
     * to. */
    void set_wall(LineState &state, std::size_t side);

    /** Add what was before the state that the solver was started from, newest first. */
    void add_older(LineState state);

    /** Advance to a time; the state is left alone unless the step is accepted. */
    StepOutcome step_to(double time);

    const LineState &state() const
    {
      return history.newest();
    }

    /** The states that the next step looks back on, to be put back if the step passed an
     * event. */
    const std::deque<LineState> &states() const
    {
      return history.states();
    }

    void restore(std::deque<LineState> earlier)
    {
      history.set(std::move(earlier));
    }

    /** The problem's nodes have moved.
     * @param before where they were
     * @param states those that the next step looks back on, at the new places */
    void nodes_moved(std::span<const double> before, std::deque<LineState> states)
    {
      collocation.nodes_moved(before);
      for(LineState &moved : states)
        find_cells(moved);
      history.set(std::move(states));
    }

    const LineCounters &counters() const
    {
      return counted;
    }

    long work() const
    {
      return collocation.work();
    }

    /** Whether a step may end at a jump of what its front leaves over: the last resort.
     */
    void accept_jumps(bool accept)
    {
      jumps_accepted = accept;
    }

    /** What an effect has cost. Phase change costs what is solved for the fronts once the
     * phases have been solved for where they are first thought to be; what is a factor of
     * all rows has neither memory nor time of its own. */
    cases::EffectCost cost(cases::Effect effect) const;

    /** Distance of two neighbouring ends below which a phase does not get (m). */
    double least_thickness() const;

  private:
    struct Trial
    {
      LineState state;          ///< fronts as tried, temperatures, speeds of Stefan's law
      std::vector<double> rate; ///< backward differences of the fronts (m/s)
      std::vector<double> defect; ///< speed - rate (m/s)
    };

    void evaluate(Trial &trial);
    using WallValue = std::function<double(double)> LineWall::*;
    void find_speeds(LineState &state, const std::vector<EndSlopes> &slopes,
                     WallValue given) const;
    void close_thin_layer(const LineInterval &interval, double growth,
                          EndSlopes &slopes) const;
    double place_before(double before, double now) const;
    void find_cells(LineState &state);
    void find_given_flux();
    void find_steep_phases();
    void add_changed_cells(std::size_t number, const LineInterval &interval,
                           LineState &state, EndSlopes &slopes) const;
    void book_walls(LineState &state) const;
    void find_history(std::size_t number, const LineInterval &interval);
    std::vector<double> predicted_fronts(double time_step) const;
    bool limit(std::vector<double> &fronts) const;
    void find_slope(const Trial &base);
    std::vector<double> correction(const std::vector<double> &defect) const;
    void update_slope(const std::vector<double> &change,
                      const std::vector<double> &before,
                      const std::vector<double> &after);
    StepOutcome iterate(Trial &trial);
    StepOutcome find_fronts(Trial &trial, bool closing);

    const LineProblem &problem;
    LineCollocation collocation;
    LineHistory history;
    std::vector<double> times;          ///< of the step in hand, its end first
    std::vector<double> weights;        ///< of backward differentiation
    std::vector<double> rate_history;   ///< of each node (K/s)
    std::array<double, 2> given_flux{}; ///< of the step in hand (W/m^2)
    /** Until when the liquid and the solid hold a layer that no node resolves (s). */
    std::array<double, 2> steep_until{-std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity()};
    std::array<bool, 2> steep{}; ///< in the step in hand
    /** Derivatives of the fronts' speeds with respect to the fronts, by rows (1/s). */
    std::vector<double> slope;
    bool slope_known = false;
    bool jumps_accepted = false;
    LineCounters counted;
    cases::EffectMeter front_meter;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
