#include <cases/error.h>
#include <cases/outcomes.h>
#include <verification/matrix/front_frame.h>
#include <verification/matrix/motion_observer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr int samples_of_every_step = 200;

    std::vector<double> copy(std::span<const double> values)
    {
      return {values.begin(), values.end()};
    }
  } // namespace

  MotionObserver::MotionObserver(const cases::Case &c, const cases::Scene &simulated,
                                 const std::string &method, cases::Observer *second)
    : the_case(c)
    , scene(simulated)
    , method(method)
    , second(second)
    , tolerance(1e-9 * (simulated.end_time - simulated.start_time))
    , samples(c.measurement.samples == 0 ? samples_of_every_step : c.measurement.samples)
    , last_time(nan)
  {
  }

  void MotionObserver::begin(const cases::RunDescription &description)
  {
    run_description = description;
    if(second)
      second->begin(description);
  }

  bool MotionObserver::at_the_end(double time) const
  {
    return time >= scene.end_time - tolerance;
  }

  bool MotionObserver::sample_is_due(long step, double time) const
  {
    const double share
        = (time - scene.start_time + tolerance) / (scene.end_time - scene.start_time);
    return step == 0 || samples * share >= next_sample;
  }

  bool MotionObserver::mark_is_due(double time) const
  {
    const std::vector<double> &marks = the_case.measurement.marks;
    return next_mark < marks.size() && time >= marks[next_mark] - tolerance;
  }

  bool MotionObserver::wants(long step, double time)
  {
    const bool second_wants = second && second->wants(step, time);
    return sample_is_due(step, time) || mark_is_due(time) || second_wants;
  }

  void MotionObserver::judge(const cases::Snapshot &snapshot) const
  {
    for(const auto &values : {snapshot.positions, snapshot.velocity, snapshot.front})
      for(const std::span<const double> component : values)
        if(!std::ranges::all_of(component, [](double x) { return std::isfinite(x); }))
          throw cases::NumericalError(method, snapshot.step, snapshot.time, "position",
                                      "is not finite");
  }

  void MotionObserver::observe(const cases::Snapshot &snapshot)
  {
    if(snapshot.step == last_step)
      return;
    judge(snapshot);
    if(sample_is_due(snapshot.step, snapshot.time) || at_the_end(snapshot.time))
      add_to_series(snapshot);
    while(mark_is_due(snapshot.time))
    {
      ++next_mark;
      measure(snapshot, fmt::format("_{}", next_mark));
      if(!mark_is_due(snapshot.time))
        keep_frame(snapshot);
    }
    if(snapshot.step == 0)
      keep_frame(snapshot);
    if(at_the_end(snapshot.time))
    {
      measure(snapshot, "_end");
      keep_frame(snapshot);
      ended = true;
    }
    if(second
       && (second->wants(snapshot.step, snapshot.time) || snapshot.step == 0
           || at_the_end(snapshot.time)))
      second->observe(snapshot);
    last_step = snapshot.step;
    last_time = snapshot.time;
  }

  void MotionObserver::add_to_series(const cases::Snapshot &snapshot)
  {
    const double share = (snapshot.time - scene.start_time + tolerance)
                         / (scene.end_time - scene.start_time);
    next_sample = static_cast<int>(samples * share) + 1;
    run_series.time.push_back(snapshot.time);
    run_series.solid_volume.push_back(std::accumulate(snapshot.solid_fraction.begin(),
                                                      snapshot.solid_fraction.end(), 0.));
  }

  void MotionObserver::measure(const cases::Snapshot &snapshot, const std::string &suffix)
  {
    if(scene.particle_solid)
      values["solid" + suffix] = std::accumulate(snapshot.solid_fraction.begin(),
                                                 snapshot.solid_fraction.end(), 0.);
  }

  void MotionObserver::keep_frame(const cases::Snapshot &snapshot)
  {
    if(!scene.particle_solid)
    {
      if(snapshot.step > 0)
        add_front_frame(snapshot, run_description.spacing, front_frames);
      return;
    }
    if(snapshot.dimension != 2)
      return;
    ParticleFrame frame;
    frame.time = snapshot.time;
    frame.step = snapshot.step;
    frame.x = copy(snapshot.positions[0]);
    frame.y = copy(snapshot.positions[1]);
    frame.velocity_x = copy(snapshot.velocity[0]);
    frame.velocity_y = copy(snapshot.velocity[1]);
    frame.solid = copy(snapshot.solid_fraction);
    particle_frames.push_back(frame);
  }

  void MotionObserver::note(double time, const std::string &event)
  {
    run_events.push_back({time, event});
    if(second)
      second->note(time, event);
  }

  void MotionObserver::outcome(const std::string &name, double value)
  {
    values[name] = value;
    if(second)
      second->outcome(name, value);
  }

  void MotionObserver::require_end() const
  {
    if(!ended)
      throw cases::NumericalError(
          method, last_step, last_time, "time",
          fmt::format("was not taken to the end, {:.6g}", scene.end_time));
  }

  void MotionObserver::keep_course(RunRecord &record) const
  {
    record.description = run_description;
    record.series = run_series;
    record.events = run_events;
  }

  void MotionObserver::keep_results(RunRecord &record) const
  {
    record.frames = front_frames;
    record.particle_frames = particle_frames;
    record.quantities = values;
  }

  const std::vector<std::string> &MotionObserver::quantity_names()
  {
    static const std::vector<std::string> names = []
    {
      std::vector<std::string> list;
      for(const cases::Outcome &outcome : cases::outcomes())
        list.push_back(outcome.name);
      for(int mark = 1; mark <= cases::most_marks; ++mark)
        list.push_back(fmt::format("solid_{}", mark));
      list.emplace_back("solid_end");
      return list;
    }();
    return names;
  }
} // namespace meltfront::verification
