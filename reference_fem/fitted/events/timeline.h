#ifndef meltfront_reference_fem_fitted_events_timeline_h
#define meltfront_reference_fem_fitted_events_timeline_h

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
   * approached in shorter and shorter steps until 1e-9 of the ray is left.
   */
  class Timeline
  {
  public:
    /** Called when a stretch begins, and after each step of it: number of the step, time
     * (s), state, and whether it is the last one. */
    struct Listener
    {
      std::function<void(const Stretch &)> begin;
      std::function<void(long, double, const dealii::Vector<double> &, bool)> step;
    };

    Timeline(EventScene setting, IntegrationOptions options, Listener listener);

    /** Run from a stretch to the end of the scene. */
    void run(Stretch first);

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
    /** Integrate a stretch; the one that follows it, if an event ends it. */
    std::optional<Stretch> integrate(const Stretch &stretch);
    std::optional<Stretch> cross_wall(const Stretch &stretch, Integrator &integrator,
                                      double before, const dealii::Vector<double> &u,
                                      double after, bool inner);
    std::optional<Stretch> approach_end(const Stretch &stretch, Integrator &integrator);
    IntegrationOptions options_for(const Stretch &stretch) const;

    /** Whether the melting temperature has been passed at an end of a one-phase stretch.
     */
    bool crossed(const Stretch &stretch, const dealii::Vector<double> &u,
                 bool inner) const;
    void begin(const Stretch &stretch);
    void accept(const Stretch &stretch, const AcceptedStep &step);

    EventScene setting;
    IntegrationOptions options;
    Listener listener;
    IntegrationCost total;
    std::vector<Event> happened;
    long steps = 0;
    double initial_heat = 0;
  };
} // namespace meltfront::reference_fem::fitted

#endif
