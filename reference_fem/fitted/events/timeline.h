#ifndef meltfront_reference_fem_fitted_events_timeline_h
#define meltfront_reference_fem_fitted_events_timeline_h

#include <reference_fem/fitted/events/cold_start.h>
#include <reference_fem/fitted/events/late_start.h>
#include <reference_fem/fitted/events/phase_check.h>
#include <reference_fem/fitted/events/transitions.h>

#include <functional>
#include <optional>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /**
   * A run through the events that change its mesh, which are followed in one dimension:
   * fronts that start at walls or a sink, fronts that reach a wall or the centre, and
   * fronts that meet.
   *
   * A wall that passes the melting temperature is found to round-off, by a root of its
   * temperature over the length of the step. A phase that is about to vanish is
   * approached in shorter and shorter steps until 1e-9 of the ray is left. Steps end
   * where the data of walls and sources have breakpoints, and divide where these vary
   * fast. Each state is checked: a phase beyond its melting point away from fronts
   * ends the run.
   */
  class Timeline
  {
  public:
    /** Called when a segment begins, and after each step of it: number of the step, time
     * (s), state, and whether it is the last one. */
    struct Listener
    {
      std::function<void(const RunSegment &)> begin;
      std::function<void(long, double, const dealii::Vector<double> &, bool)> step;
      /** Asked before a state whose phases are wrong ends the run: throws if it knows the
       * cause. */
      std::function<void(double, const dealii::Vector<double> &)> find_cause;
    };

    Timeline(EventScene setting, IntegrationOptions options, Listener listener);

    /** Run from a segment to the end of the scene. */
    void run(RunSegment first);

    /** What has happened, in the order of time. */
    const std::vector<Event> &events() const
    {
      return happened;
    }

    const IntegrationCost &cost() const
    {
      return total;
    }

  private:
    /** The end of a step that was accepted: where to go on from. */
    struct Point
    {
      double clock = 0;
      dealii::Vector<double> u, rate;
    };

    /** What ends a row of steps before its end. */
    struct Halt
    {
      std::vector<WallCrossing> crossings; ///< walls pass the melting temperature
      bool shrinks = false;                ///< a phase is about to vanish
    };

    /** Integrate a segment; the one that follows it, if an event ends it. */
    std::optional<RunSegment> integrate(const RunSegment &segment);

    /** The time of the next jump of what a wall prescribes, infinite without one. */
    double next_jump(double time) const;

    /** A segment ends so long before a jump, and the next begins so long after it (s). */
    double beside_jump() const
    {
      return 1e-13 * setting.scene.end_time;
    }

    Halt take_planned_steps(const RunSegment &segment,
                            const std::vector<StepRange> &ranges, Integrator &integrator,
                            Point &last);

    /** Short steps to the moment at which a phase vanishes, or turns out not to. */
    std::optional<RunSegment> approach_end(const RunSegment &segment,
                                           const std::vector<StepRange> &ranges,
                                           Integrator &integrator, Point &last);

    /** Segments from a state whose walls start fronts or layers of heat at once. */
    std::optional<RunSegment> set_out(const RunSegment &segment,
                                      const LayeredState &state) const;

    /** The segment anew with finer cells and steps if a wall passes the melting
     * temperature within the first of its steps. */
    std::optional<RunSegment> refined(const RunSegment &segment,
                                      const std::vector<StepRange> &steps);
    bool may_pass_early(const RunSegment &segment) const;

    /** The segment after the first of walls to pass the melting temperature has done so;
     * in timeline_walls.cc, as all that it takes. */
    RunSegment pass_walls(const RunSegment &segment, Integrator &integrator,
                          const Point &before,
                          const std::vector<WallCrossing> &crossings);
    /** When a wall passes the melting temperature, and a clock at which it has not. */
    struct LocatedPassing
    {
      WallPassing passing;
      double clock = 0;
    };
    LocatedPassing locate(const RunSegment &segment, Integrator &integrator,
                          const Point &before, const WallCrossing &crossing) const;

    /** Whether a wall of fixed temperature jumped when it passed the melting
     * temperature. */
    bool has_jumped(const RunSegment &segment, const WallPassing &passing) const;

    /** The run on from a jump of a wall: fronts that start, layers of heat that form. */
    RunSegment after_jump(const RunSegment &segment, double time,
                          const dealii::Vector<double> &u) const;

    IntegrationOptions options_for(const RunSegment &segment) const;
    void begin(const RunSegment &segment);
    void accept(const RunSegment &segment, const AcceptedStep &step, Point &last);
    bool follows_events() const
    {
      return setting.options.dimension == 1;
    }

    EventScene setting;
    IntegrationOptions options;
    Listener listener;
    PhaseCheck phases;
    IntegrationCost total;
    std::vector<Event> happened;
    long steps = 0;
  };
} // namespace meltfront::reference_fem::fitted

#endif
