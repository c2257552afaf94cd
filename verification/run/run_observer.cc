#include <cases/error.h>
#include <verification/run/front_frame.h>
#include <verification/run/run_observer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr int samples_of_every_step = 200;

    /** Relative to the duration: a time this near another is the same. */
    constexpr double time_tolerance = 1e-9;
  } // namespace

  RunObserver::RunObserver(const cases::Case &c, const cases::Scene &simulated,
                           const std::string &method, cases::Observer *second)
    : the_case(c)
    , scene(simulated)
    , method(method)
    , samples(c.measurement.samples == 0 ? samples_of_every_step : c.measurement.samples)
    , tolerance(time_tolerance * (simulated.end_time - simulated.start_time))
    , second(second)
    , last_time(std::nan(""))
  {
  }

  void RunObserver::begin(const cases::RunDescription &of_run)
  {
    description = of_run;
    start();
    if(second)
      second->begin(of_run);
  }

  void RunObserver::start_measures(MeasuredScenes scenes,
                                   const InterfaceComparison *carried)
  {
    started = measures_for(scenes, {the_case, scene, description.spacing, carried});
  }

  double RunObserver::clock(double time) const
  {
    const bool roots = the_case.measurement.square_root_clock;
    const auto reading = [&](double t) { return roots ? std::sqrt(t) : t; };
    return (reading(time) - reading(scene.start_time))
           / (reading(scene.end_time) - reading(scene.start_time));
  }

  bool RunObserver::sample_is_due(long step, double time) const
  {
    return step == 0 || samples * (clock(time) + time_tolerance) >= next_sample;
  }

  bool RunObserver::intermediate_is_due(double time) const
  {
    const std::vector<double> &intermediate_times
        = the_case.measurement.intermediate_times;
    return next_intermediate < intermediate_times.size()
           && time >= intermediate_times[next_intermediate] - tolerance;
  }

  bool RunObserver::wants(long step, double time)
  {
    const bool asked = asks_for(step, time);
    const bool second_wants = second && second->wants(step, time);
    return asked || second_wants
           || std::ranges::any_of(started, [](const auto &measure)
                                  { return measure->wants_every_step(); });
  }

  std::vector<double> RunObserver::wanted_times() const
  {
    const bool roots = the_case.measurement.square_root_clock;
    const double start = roots ? std::sqrt(scene.start_time) : scene.start_time;
    const double end = roots ? std::sqrt(scene.end_time) : scene.end_time;
    std::vector<double> times;
    for(int k = 0; k <= samples; ++k)
    {
      const double reading = start + k * (end - start) / samples;
      times.push_back(roots ? reading * reading : reading);
    }
    for(const double time : the_case.measurement.intermediate_times)
      if(time > scene.start_time && time < scene.end_time)
        times.push_back(time);
    std::ranges::sort(times);
    const auto same
        = [this](double one, double other) { return other - one <= tolerance; };
    times.erase(std::unique(times.begin(), times.end(), same), times.end());
    times.front() = scene.start_time;
    times.back() = scene.end_time;
    return times;
  }

  void RunObserver::observe(const cases::Snapshot &snapshot)
  {
    if(snapshot.step == last_step)
      return;
    look(snapshot);
    for(const auto &measure : started)
      measure->watch(snapshot);
    const bool at_end = clock(snapshot.time) >= 1 - time_tolerance;
    if(asks_for(snapshot.step, snapshot.time) || at_end)
    {
      Sighting sighting{.snapshot = snapshot, .at_end = at_end};
      sighting.in_series = at_end || sample_is_due(snapshot.step, snapshot.time);
      while(intermediate_is_due(snapshot.time))
        sighting.intermediate_times.push_back(static_cast<int>(++next_intermediate));
      if(sighting.in_series)
        next_sample
            = static_cast<int>(samples * (clock(snapshot.time) + time_tolerance)) + 1;
      see(std::move(sighting));
    }
    ended = ended || at_end;
    if(second
       && (second->wants(snapshot.step, snapshot.time) || snapshot.step == 0 || at_end))
      second->observe(snapshot);
    last_step = snapshot.step;
    last_time = snapshot.time;
  }

  void RunObserver::observe_with_all(const Sighting &sighting)
  {
    for(const auto &measure : started)
      measure->observe(sighting);
  }

  void RunObserver::keep_front(const cases::Snapshot &snapshot)
  {
    add_front_frame(snapshot, description.spacing, front_frames);
  }

  void RunObserver::note(double time, const std::string &event)
  {
    run_events.push_back({time, event});
    if(second)
      second->note(time, event);
  }

  void RunObserver::require_end() const
  {
    if(!ended)
      throw cases::NumericalError(
          method, last_step, last_time, "time",
          fmt::format("was not taken to the end, {:.6g}", scene.end_time));
  }

  void RunObserver::keep_course(RunRecord &record) const
  {
    record.description = description;
    record.series = run_series;
    record.events = run_events;
  }

  void RunObserver::keep_results(RunRecord &record) const
  {
    record.frames = front_frames;
    record.quantities = quantities();
  }

  const RunSeries &RunObserver::series() const
  {
    return run_series;
  }

  const std::vector<FrontFrame> &RunObserver::frames() const
  {
    return front_frames;
  }

  Results RunObserver::quantities() const
  {
    Results values;
    for(const auto &measure : started)
      values.merge(measure->results());
    return values;
  }
} // namespace meltfront::verification
