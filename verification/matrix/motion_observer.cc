#include <cases/error.h>
#include <cases/numbers.h>
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
    using cases::nan;

    constexpr int pictures_before_mark = 12, most_pictures = 60;
    constexpr std::size_t most_animated = 2000;

    constexpr const char *interface_names[]
        = {"volume_error", "front_l1",   "shape_mismatch", "shape_missing",
           "shape_extra",  "normal_rms", "curvature_rms"};

    std::array<double, std::size(interface_names)>
    values_of(const InterfaceErrors &errors)
    {
      return {errors.volume, errors.front,  errors.mismatch, errors.missing,
              errors.extra,  errors.normal, errors.curvature};
    }

    /** Values for pictures: five digits of the largest, so that records stay small. */
    std::vector<double> rounded(std::span<const double> values)
    {
      double largest = 0;
      for(const double value : values)
        largest = std::max(largest, std::abs(value));
      std::vector<double> result(values.begin(), values.end());
      if(largest > 1e-100) // else there is nothing to see
      {
        double scale = 1;
        while(scale * largest < 1e4)
          scale *= 10;
        while(scale * largest >= 1e5)
          scale /= 10;
        for(double &value : result)
          value = std::round(value * scale) / scale;
      }
      return result;
    }

    ParticleFrame frame_of(const cases::Snapshot &snapshot)
    {
      return {snapshot.time,
              snapshot.step,
              rounded(snapshot.positions[0]),
              rounded(snapshot.positions[1]),
              rounded(snapshot.velocity[0]),
              rounded(snapshot.velocity[1]),
              {snapshot.solid_fraction.begin(), snapshot.solid_fraction.end()}};
    }

    /** Equidistant from the start to the first mark, and from there to the end. */
    std::vector<double> times_of_pictures(const cases::Scene &scene,
                                          const std::vector<double> &marks)
    {
      std::vector<double> times;
      const bool marked = !marks.empty() && marks.front() > scene.start_time
                          && marks.front() < scene.end_time;
      const double turn = marked ? marks.front() : scene.start_time;
      const int before = marked ? pictures_before_mark : 0;
      for(int i = 0; i < before; ++i)
        times.push_back(scene.start_time + (turn - scene.start_time) * i / before);
      const int after = most_pictures - before;
      for(int i = 0; i <= after; ++i)
        times.push_back(turn + (scene.end_time - turn) * i / after);
      return times;
    }
  } // namespace

  MotionObserver::MotionObserver(const cases::Case &c, const cases::Scene &simulated,
                                 const std::string &method, cases::Observer *second,
                                 bool animated)
    : the_case(c)
    , scene(simulated)
    , method(method)
    , second(second)
    , tolerance(1e-9 * (simulated.end_time - simulated.start_time))
    , samples(c.measurement.samples == 0 ? samples_of_every_step : c.measurement.samples)
    , last_time(nan)
  {
    if(animated && simulated.particle_solid)
      picture_times = times_of_pictures(simulated, c.measurement.marks);
  }

  void MotionObserver::begin(const cases::RunDescription &description)
  {
    run_description = description;
    if(scene.interface)
      comparison.emplace(scene, description.spacing);
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

  bool MotionObserver::picture_is_due(double time) const
  {
    return next_picture < picture_times.size()
           && time >= picture_times[next_picture] - tolerance;
  }

  bool MotionObserver::wants(long step, double time)
  {
    const bool second_wants = second && second->wants(step, time);
    return sample_is_due(step, time) || mark_is_due(time) || picture_is_due(time)
           || second_wants;
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
    keep_picture(snapshot);
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
    if(scene.particle_solid)
      run_series.solid_volume.push_back(std::accumulate(
          snapshot.solid_fraction.begin(), snapshot.solid_fraction.end(), 0.));
    else if(snapshot.level_set && scene.domain.dimension == 2)
      run_series.solid_volume.push_back(comparison->volume(snapshot));
    else
      run_series.solid_volume.push_back(nan);
  }

  void MotionObserver::measure(const cases::Snapshot &snapshot, const std::string &suffix)
  {
    if(scene.particle_solid)
      values["solid" + suffix] = std::accumulate(snapshot.solid_fraction.begin(),
                                                 snapshot.solid_fraction.end(), 0.);
    if(!comparison || !snapshot.level_set)
      return;
    const auto errors = values_of(comparison->errors(snapshot));
    for(std::size_t i = 0; i < errors.size(); ++i)
      values[interface_names[i] + suffix] = errors[i];
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
    if(!particle_frames.empty() && particle_frames.back().step == snapshot.step)
      return; // a mark at the end
    particle_frames.push_back(frame_of(snapshot));
  }

  void MotionObserver::keep_picture(const cases::Snapshot &snapshot)
  {
    if(!picture_is_due(snapshot.time))
      return;
    while(picture_is_due(snapshot.time))
      ++next_picture;
    if(snapshot.dimension == 2 && snapshot.positions[0].size() <= most_animated)
      animation.push_back(frame_of(snapshot));
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
    record.animation = animation;
    record.quantities = values;
  }

  const std::vector<std::string> &MotionObserver::quantity_names()
  {
    static const std::vector<std::string> names = []
    {
      std::vector<std::string> list;
      for(const cases::Outcome &outcome : cases::outcomes())
        list.push_back(outcome.name);
      std::vector<std::string> suffixes;
      for(int mark = 1; mark <= cases::most_marks; ++mark)
        suffixes.push_back(fmt::format("_{}", mark));
      suffixes.emplace_back("_end");
      for(const std::string &suffix : suffixes)
      {
        list.push_back("solid" + suffix);
        for(const char *name : interface_names)
          list.push_back(name + suffix);
      }
      return list;
    }();
    return names;
  }
} // namespace meltfront::verification
