#ifndef meltfront_reference_fem_fitted_events_timeline_h
#define meltfront_reference_fem_fitted_events_timeline_h

#include <reference_fem/fitted/events/phase_check.h>
#include <reference_fem/fitted/events/transitions.h>

#include <functional>
#include <optional>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /**
   * A run through the events that change its mesh, which are followed in one dimension: a
   * front that starts at a wall or a sink, and one that reaches a wall or the centre.
   *
   * A wall that passes the melting temperature is found to round-off, by a root of its
   * temperature over the length of the step. A front that is about to reach an end is
   * approached in shorter and shorter steps until 1e-9 of the ray is left. Steps end
   * where the data of walls and sources have breakpoints, and divide where these vary
   * fast. Each state is checked: a phase beyond its melting point away from the front
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
      dealii::Vector<double> u;
      double front_rate = 0; ///< of the front on the first ray
    };

    /** Integrate a segment; the one that follows it, if an event ends it. */
    std::optional<RunSegment> integrate(const RunSegment &segment);

    /** One phase until a wall passes the melting temperature. */
    std::optional<RunSegment> integrate_phase(const RunSegment &segment,
                                              const std::vector<StepRange> &steps,
                                              Integrator &integrator);

    /** A front until it reaches an end. */
    std::optional<RunSegment> integrate_front(const RunSegment &segment,
                                              const std::vector<StepRange> &steps,
                                              Integrator &integrator);

    /** The segment anew with finer cells and steps if a wall passes the melting
     * temperature within the first of its steps. */
    std::optional<RunSegment> refined(const RunSegment &segment,
                                      const std::vector<StepRange> &steps);
    std::optional<RunSegment> cross_wall(const RunSegment &segment,
                                         Integrator &integrator, const Point &before,
                                         const WallCrossing &crossing);

    /** Whether a wall of fixed temperature jumped when it passed the melting
     * temperature, and the front that it starts then. */
    bool has_jumped(const RunSegment &segment, double time, bool inner) const;
    std::optional<RunSegment> after_jump(const RunSegment &segment, double time,
                                         const dealii::Vector<double> &u, bool inner);
    std::optional<RunSegment> approach_end(const RunSegment &segment,
                                           const std::vector<StepRange> &steps,
                                           Integrator &integrator, Point last);
    IntegrationOptions options_for(const RunSegment &segment) const;
    void begin(const RunSegment &segment);
    void accept(const RunSegment &segment, const AcceptedStep &step);

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
