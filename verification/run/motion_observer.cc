#include <cases/error.h>
#include <verification/run/motion_observer.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    constexpr int pictures_before_intermediate = 12, most_pictures = 60;
    constexpr std::size_t most_animated = 2000;

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

    /** Particles of space as they are seen from the front, a little from the right and
     * from above; the farthest come first. */
    ParticleFrame view_of(const cases::Snapshot &snapshot)
    {
      constexpr double turn = 0.5, tilt = 0.35; // radians
      const std::size_t n = snapshot.positions[0].size();
      std::vector<double> depth(n);
      const auto seen = [&](const auto &vector, std::size_t i)
      {
        const double x = vector[0][i], y = vector[1][i], z = vector[2][i];
        const double across = std::cos(turn) * x - std::sin(turn) * z,
                     along = std::sin(turn) * x + std::cos(turn) * z;
        return cases::Position{across, std::cos(tilt) * y - std::sin(tilt) * along,
                               std::sin(tilt) * y + std::cos(tilt) * along};
      };
      std::vector<std::size_t> order(n);
      std::iota(order.begin(), order.end(), 0);
      for(std::size_t i = 0; i < n; ++i)
        depth[i] = seen(snapshot.positions, i)[2];
      std::ranges::stable_sort(order, {}, [&depth](std::size_t i) { return depth[i]; });
      std::array<std::vector<double>, 4> values;
      std::vector<double> solid;
      for(const std::size_t i : order)
      {
        const cases::Position place = seen(snapshot.positions, i),
                              velocity = seen(snapshot.velocity, i);
        for(std::size_t d = 0; d < 2; ++d)
        {
          values[d].push_back(place[d]);
          values[2 + d].push_back(velocity[d]);
        }
        solid.push_back(snapshot.solid_fraction[i]);
      }
      return {snapshot.time,
              snapshot.step,
              rounded(values[0]),
              rounded(values[1]),
              rounded(values[2]),
              rounded(values[3]),
              solid};
    }

    ParticleFrame frame_of(const cases::Snapshot &snapshot)
    {
      if(snapshot.dimension == 3)
        return view_of(snapshot);
      return {snapshot.time,
              snapshot.step,
              rounded(snapshot.positions[0]),
              rounded(snapshot.positions[1]),
              rounded(snapshot.velocity[0]),
              rounded(snapshot.velocity[1]),
              {snapshot.solid_fraction.begin(), snapshot.solid_fraction.end()}};
    }

    /** Equidistant from the start to the first intermediate time, and from there to the
     * end. */
    std::vector<double> times_of_pictures(const cases::Scene &scene,
                                          const std::vector<double> &intermediate_times)
    {
      std::vector<double> times;
      const bool marked = !intermediate_times.empty()
                          && intermediate_times.front() > scene.start_time
                          && intermediate_times.front() < scene.end_time;
      const double turn = marked ? intermediate_times.front() : scene.start_time;
      const int before = marked ? pictures_before_intermediate : 0;
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
    : RunObserver(c, simulated, method, second)
  {
    if(animated && simulated.particle_solid)
      picture_times = times_of_pictures(simulated, c.measurement.intermediate_times);
  }

  void MotionObserver::start()
  {
    if(scene.interface)
      comparison.emplace(scene, description.spacing);
    start_measures(MeasuredScenes::in_motion, comparison ? &*comparison : nullptr);
  }

  bool MotionObserver::picture_is_due(double time) const
  {
    return next_picture < picture_times.size()
           && time >= picture_times[next_picture] - tolerance;
  }

  bool MotionObserver::asks_for(long step, double time)
  {
    return sample_is_due(step, time) || intermediate_is_due(time) || picture_is_due(time);
  }

  void MotionObserver::look(const cases::Snapshot &snapshot)
  {
    for(const auto &values : {snapshot.positions, snapshot.velocity, snapshot.front})
      for(const std::span<const double> component : values)
        if(!std::ranges::all_of(component, [](double x) { return std::isfinite(x); }))
          throw cases::NumericalError(method, snapshot.step, snapshot.time, "position",
                                      "is not finite");
  }

  double MotionObserver::volume(const Sighting &sighting) const
  {
    const cases::Snapshot &snapshot = sighting.snapshot;
    if(scene.particle_solid)
      return std::accumulate(snapshot.solid_fraction.begin(),
                             snapshot.solid_fraction.end(), 0.);
    return sighting.in_series && snapshot.level_set && scene.domain.dimension == 2
               ? comparison->volume(snapshot)
               : std::nan("");
  }

  void MotionObserver::see(Sighting sighting)
  {
    const cases::Snapshot &snapshot = sighting.snapshot;
    sighting.solid_volume = volume(sighting);
    if(sighting.in_series)
    {
      run_series.time.push_back(snapshot.time);
      run_series.solid_volume.push_back(sighting.solid_volume);
    }
    observe_with_all(sighting);
    if(snapshot.step == 0 || !sighting.intermediate_times.empty())
      keep_frame(snapshot);
    keep_picture(snapshot);
    if(sighting.at_end)
      keep_frame(snapshot);
  }

  void MotionObserver::keep_frame(const cases::Snapshot &snapshot)
  {
    if(!scene.particle_solid)
    {
      if(snapshot.step > 0)
        keep_front(snapshot);
      return;
    }
    if(!particle_frames.empty() && particle_frames.back().step == snapshot.step)
      return; // an intermediate time at the end
    particle_frames.push_back(frame_of(snapshot));
  }

  void MotionObserver::keep_picture(const cases::Snapshot &snapshot)
  {
    if(!picture_is_due(snapshot.time))
      return;
    while(picture_is_due(snapshot.time))
      ++next_picture;
    if(snapshot.positions[0].size() <= most_animated)
      animation.push_back(frame_of(snapshot));
  }

  void MotionObserver::report(const std::string &name, double value)
  {
    told[name] = value;
    if(second)
      second->report(name, value);
  }

  void MotionObserver::keep_results(RunRecord &record) const
  {
    RunObserver::keep_results(record);
    record.particle_frames = particle_frames;
    record.animation = animation;
  }

  Results MotionObserver::quantities() const
  {
    Results values = RunObserver::quantities();
    values.insert(told.begin(), told.end());
    return values;
  }
} // namespace meltfront::verification
