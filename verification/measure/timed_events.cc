#include <verification/measure/formulas/event_watch.h>
#include <verification/measure/measure.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    /** The times of Measurement::events (s), for which every step is watched until they
     * have happened. */
    class TimedEvents : public Measure
    {
    public:
      explicit TimedEvents(const MeasuredRun &run)
        : Measure(run)
        , events(run.scene, run.the_case.measurement.events, run.spacing)
      {
      }

      static bool asked_for(const MeasuredRun &run)
      {
        return !run.the_case.measurement.events.empty();
      }

      bool wants_every_step() const override
      {
        return events.pending();
      }

      void watch(const cases::Snapshot &snapshot) override
      {
        if(!events.pending())
          return;
        events.observe(snapshot);
        for(const cases::TimedEvent event : run.the_case.measurement.events)
          values[cases::timed_event_names[static_cast<std::size_t>(event)]]
              = events.time(event);
      }

      void observe(const Sighting &) override
      {
      }

    private:
      EventWatch events;
    };
  } // namespace

  MeasureKind timed_events()
  {
    std::vector<Quantity> all;
    for(const char *name : cases::timed_event_names)
    {
      std::string words = name;
      std::ranges::replace(words, '_', ' ');
      auto list = with_differences(value_quantity(name, words, "s"));
      list[0].digits = 8;
      all.insert(all.end(), list.begin(), list.end());
    }
    return {all, MeasuredScenes::with_heat, start<TimedEvents>};
  }
} // namespace meltfront::verification
