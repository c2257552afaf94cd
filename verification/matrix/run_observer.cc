#include <cases/error.h>
#include <cases/numbers.h>
#include <verification/matrix/end_profile.h>
#include <verification/matrix/front_frame.h>
#include <verification/matrix/run_observer.h>
#include <verification/measure/front_shape.h>
#include <verification/measure/square_law.h>
#include <verification/measure/temperature_error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;
    constexpr int fewest_samples = 50;

    /** Relative to the duration: a time this near another is the same. */
    constexpr double time_tolerance = 1e-9;

    double partly_frozen_fraction(const cases::Snapshot &snapshot)
    {
      double sum = 0;
      int sites = 0;
      for(std::size_t i = 0; i < snapshot.solid_fraction.size(); ++i)
      {
        const double fraction = snapshot.solid_fraction[i];
        if(snapshot.weights[i] > 0 && fraction > 0 && fraction < 1)
        {
          sum += fraction;
          ++sites;
        }
      }
      return sites > 0 ? sum / sites : nan;
    }
  } // namespace

  RunObserver::RunObserver(const cases::Case &c, const cases::Scene &simulated,
                           const std::string &method,
                           const cases::Capabilities &capabilities,
                           cases::Observer *second)
    : the_case(c)
    , scene(simulated)
    , exact(c.exact.get())
    , method(method)
    , second(second)
    , capabilities(capabilities)
    , samples(c.measurement.samples == 0 ? samples_of_every_step : c.measurement.samples)
    , last_time(nan)
    , farthest_point(nan)
    , overshoot(nan)
    , marks(c.measurement.marks)
    , worst_defect(nan)
    , worst_asymmetry(nan)
  {
    if(!(scene.end_time > scene.start_time))
      throw cases::InputError(fmt::format(
          "{}: the end time {} is not after the start time {}, so that there is "
          "nothing to measure",
          scene.name, scene.end_time, scene.start_time));
    if(samples < fewest_samples)
      throw cases::InputError(fmt::format("{}: {} samples are too few for a root mean "
                                          "square over time; take {} or more, or "
                                          "0 for every step",
                                          scene.name, samples, fewest_samples));
  }

  void RunObserver::begin(const cases::RunDescription &description)
  {
    run_description = description;
    checks.emplace(scene, capabilities, method, description.spacing);
    reader.emplace(scene, exact, description.spacing, description.smoothing_length);
    event_watch.emplace(scene, the_case.measurement.events, description.spacing);
    if(the_case.measurement.mirror)
      mirror.emplace(*the_case.measurement.mirror, description.spacing);
    alloy.emplace(the_case, scene, description.spacing);
    if(second)
      second->begin(description);
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

  bool RunObserver::wants_itself(long step, double time) const
  {
    return the_case.measurement.samples == 0 || sample_is_due(step, time)
           || marks.near_mark();
  }

  bool RunObserver::wants(long step, double time)
  {
    marks.pass(step, time);
    const bool second_wants = second && second->wants(step, time);
    return wants_itself(step, time) || second_wants
           || (event_watch && event_watch->pending());
  }

  void RunObserver::observe(const cases::Snapshot &snapshot)
  {
    if(snapshot.step == last_step)
      return;
    marks.pass(snapshot.step, snapshot.time);
    if(event_watch && event_watch->pending())
      event_watch->observe(snapshot);
    const bool at_the_end = clock(snapshot.time) >= 1 - time_tolerance;
    const bool keep = at_the_end || sample_is_due(snapshot.step, snapshot.time);
    if(wants_itself(snapshot.step, snapshot.time) || at_the_end)
      measure(snapshot, keep);
    if(at_the_end)
      measure_end(snapshot);
    if(second
       && (second->wants(snapshot.step, snapshot.time) || snapshot.step == 0
           || at_the_end))
      second->observe(snapshot);
    last_step = snapshot.step;
    last_time = snapshot.time;
  }

  void RunObserver::note(double time, const std::string &event)
  {
    run_events.push_back({time, event});
    if(second)
      second->note(time, event);
  }

  void RunObserver::measure(const cases::Snapshot &snapshot, bool keep)
  {
    checks->judge(snapshot);
    const auto [lowest, highest] = std::ranges::minmax(snapshot.temperature);
    const cases::TemperatureBounds &bounds = checks->bounds();
    const double beyond = std::max({bounds.lower - lowest, highest - bounds.upper, 0.});
    if(std::isfinite(bounds.upper - bounds.lower))
      overshoot
          = std::fmax(overshoot, beyond > 0 ? beyond / (bounds.upper - bounds.lower) : 0);
    volume_times.push_back(snapshot.time);
    // Where no phase changes there is no front to read.
    const bool changes_phase = scene.changes_phase();
    volumes.push_back(changes_phase ? solid_volume(snapshot) : nan);
    if(changes_phase)
      volume_course.add(volumes.back());
    keep_frame(snapshot);
    const FrontReading reading
        = changes_phase ? reader->read(snapshot) : FrontReading{nan, nan, nan, nan};
    alloy->add(snapshot, reader->coordinates(snapshot));
    if(changes_phase)
      course.add(reading.latent_heat);
    worst_defect = std::fmax(worst_defect, snapshot.heat.defect());
    if(mirror)
      worst_asymmetry = std::fmax(worst_asymmetry, mirror->largest_difference(snapshot));
    // Steps that are wanted for a mark only would weigh its neighbourhood.
    if(exact && (keep || the_case.measurement.samples == 0))
      compare_fronts(snapshot, reading);
    if(keep)
      add_to_series(snapshot, reading, lowest, highest);
  }

  bool RunObserver::round_front() const
  {
    const cases::Symmetry symmetry = exact ? exact->symmetry() : scene.symmetry;
    return symmetry == cases::Symmetry::cylindrical
           || symmetry == cases::Symmetry::spherical;
  }

  void RunObserver::keep_frame(const cases::Snapshot &snapshot)
  {
    const std::vector<double> &times = the_case.measurement.marks;
    const double tolerance = time_tolerance * (scene.end_time - scene.start_time);
    // Marks before the first snapshot with points are not drawn late.
    while(next_mark < times.size() && snapshot.time >= times[next_mark] - tolerance)
    {
      ++next_mark;
      if(next_mark == times.size() || snapshot.time < times[next_mark] - tolerance)
        add_front_frame(snapshot, run_description.spacing, front_frames);
    }
  }

  void RunObserver::add_to_series(const cases::Snapshot &snapshot,
                                  const FrontReading &reading, double lowest,
                                  double highest)
  {
    next_sample = static_cast<int>(samples * (clock(snapshot.time) + time_tolerance)) + 1;
    run_series.time.push_back(snapshot.time);
    run_series.front.push_back(reading.latent_heat);
    run_series.front_isotherm.push_back(reading.isotherm);
    run_series.solid_volume.push_back(volumes.back());
    run_series.budget_defect.push_back(snapshot.heat.defect());
    run_series.temperature_min.push_back(lowest);
    run_series.temperature_max.push_back(highest);
    if(exact)
      run_series.front_exact.push_back(exact_front(snapshot.time));
  }

  double RunObserver::exact_front(double time) const
  {
    return time >= exact->start_time() ? exact->front(time) : nan;
  }

  void RunObserver::compare_fronts(const cases::Snapshot &snapshot,
                                   const FrontReading &reading)
  {
    const double expected = exact_front(snapshot.time);
    if(std::isnan(expected) || (snapshot.step == 0 && expected == 0))
      return;
    front.add(reading.latent_heat - expected);
    if(snapshot.time >= (scene.start_time + scene.end_time) / 2)
      late_front.add(reading.latent_heat - expected);
    isotherm.add(reading.isotherm - expected);
    if(const auto distance = front_distance(snapshot, *exact))
    {
      front_points.add(distance->root_mean_square);
      farthest_point = std::fmax(farthest_point, distance->largest);
    }
    if(std::isnan(reading.max_ice))
      return;
    max_ice.add(reading.max_ice - expected);
    heat_loss.add(reading.heat_loss - expected);
  }

  void RunObserver::measure_end(const cases::Snapshot &snapshot)
  {
    const std::vector<double> &coordinates = reader->coordinates(snapshot);
    end_profile = make_end_profile(snapshot, coordinates, exact, run_description.spacing);
    alloy->measure_end(snapshot, coordinates);
    at_end["front_end_position"] = run_series.front.back();
    if(scene.changes_phase())
      at_end["front_row_solid_fraction"] = partly_frozen_fraction(snapshot);
    at_end["solid_volume_end"] = volumes.back();
    const int mode = the_case.measurement.front_mode;
    if(mode > 0)
      at_end["front_mode_end"] = front_mode_amplitude(
          snapshot, scene.domain, solid_holds_origin(scene, exact), mode);
    if(scene.changes_phase() && round_front())
      at_end["roundness_end"] = roundness(snapshot);
    if(front_frames.empty() || front_frames.back().time < snapshot.time)
      add_front_frame(snapshot, run_description.spacing, front_frames);
    if(!exact)
      return;
    at_end["front_end"]
        = std::abs(run_series.front.back() - run_series.front_exact.back());
    const TemperatureError error = temperature_error(
        snapshot, coordinates, *exact, scene.material.melting_temperature,
        the_case.measurement.temperature_from, the_case.measurement.temperature_to);
    at_end["temperature_l2"] = error.l2;
    at_end["temperature_max"] = error.maximum;
    at_end["temperature_rmse"] = error.rmse;
    at_end["temperature_sites_l2"] = error.sites_l2;
  }

  void RunObserver::require_end() const
  {
    if(at_end.empty())
      throw cases::NumericalError(
          method, last_step, last_time, "time",
          fmt::format("was not taken to the end, {:.6g}", scene.end_time));
  }

  void RunObserver::keep_course(RunRecord &record) const
  {
    record.description = run_description;
    record.series = run_series;
    record.events = run_events;
    if(!checks)
      return;
    record.checks = checks->checks();
    record.unchecked = checks->unchecked();
  }

  void RunObserver::keep_results(RunRecord &record) const
  {
    record.profile = end_profile;
    record.mark_profiles = mark_profiles();
    record.frames = front_frames;
    record.quantities = quantities();
  }

  const cases::RunDescription &RunObserver::description() const
  {
    return run_description;
  }

  const RunSeries &RunObserver::series() const
  {
    return run_series;
  }

  const RunProfile &RunObserver::profile() const
  {
    return end_profile;
  }

  std::vector<RunProfile> RunObserver::mark_profiles() const
  {
    return alloy ? alloy->profiles() : std::vector<RunProfile>();
  }

  const std::vector<RunEvent> &RunObserver::events() const
  {
    return run_events;
  }

  const std::vector<FrontFrame> &RunObserver::frames() const
  {
    return front_frames;
  }

  const std::vector<std::string> &RunObserver::quantity_names()
  {
    static const std::vector<std::string> names = []
    {
      std::vector<std::string> list{"front_rms",
                                    "front_max",
                                    "front_end",
                                    "front_end_position",
                                    "front_rms_relative",
                                    "front_end_relative",
                                    "front_late_max_relative",
                                    "front_isotherm_rms",
                                    "front_max_ice_rms",
                                    "front_heat_loss_rms",
                                    "front_points_rms",
                                    "front_points_max",
                                    "roundness_end",
                                    "front_row_solid_fraction",
                                    "front_backsteps",
                                    "front_mode_end",
                                    "front_floor",
                                    "front_square_slope",
                                    "front_square_r2",
                                    "solid_volume_end",
                                    "solid_volume_backsteps",
                                    "temperature_l2",
                                    "temperature_max",
                                    "temperature_rmse",
                                    "temperature_sites_l2",
                                    "temperature_overshoot",
                                    "budget_defect",
                                    "mirror_asymmetry"};
      for(int mark = 1; mark <= cases::most_marks; ++mark)
        list.push_back(fmt::format("solid_volume_{}", mark));
      for(const char *event : cases::timed_event_names)
        list.emplace_back(event);
      const std::vector<std::string> &of_alloys = AlloyMeasures::quantity_names();
      list.insert(list.end(), of_alloys.begin(), of_alloys.end());
      return list;
    }();
    return names;
  }

  void RunObserver::add_volumes(std::map<std::string, double> &values) const
  {
    const std::vector<double> &times = the_case.measurement.marks;
    const double tolerance = time_tolerance * (scene.end_time - scene.start_time);
    for(std::size_t i = 0; i < times.size(); ++i)
      values[fmt::format("solid_volume_{}", i + 1)]
          = interpolated(volume_times, volumes, times[i], tolerance);
    const double net = volume_course.net_advance();
    if(net != 0)
      values["solid_volume_backsteps"]
          = volume_course.largest_backstep(net < 0) / std::abs(net);
  }

  std::map<std::string, double> RunObserver::quantities() const
  {
    const double end = exact ? std::abs(exact->front(scene.end_time)) : nan;
    std::map<std::string, double> values;
    for(const std::string &name : quantity_names())
      values[name] = nan;
    for(const auto &[name, value] : at_end)
      values[name] = value;
    if(alloy)
      for(const auto &[name, value] : alloy->quantities())
        values[name] = value;
    // Fewer steps than that are no average over the run.
    const double rms = front.samples() >= fewest_samples ? front.root_mean_square() : nan;
    values["front_rms"] = rms;
    values["front_max"] = front.largest();
    values["front_rms_relative"] = rms / end;
    values["front_end_relative"] = values["front_end"] / end;
    values["front_late_max_relative"] = late_front.largest() / end;
    values["front_isotherm_rms"] = isotherm.root_mean_square();
    values["front_max_ice_rms"] = max_ice.root_mean_square();
    values["front_heat_loss_rms"] = heat_loss.root_mean_square();
    if(front_points.samples() >= fewest_samples)
      values["front_points_rms"] = front_points.root_mean_square();
    values["front_points_max"] = farthest_point;
    add_volumes(values);
    values["temperature_overshoot"] = overshoot;
    const double advance
        = exact ? exact->front(scene.end_time) - exact->front(scene.start_time)
                : course.net_advance();
    values["front_backsteps"] = course.largest_backstep(advance < 0);
    if(the_case.measurement.front_square_from)
    {
      const SquareLaw law = square_law(run_series.time, run_series.front,
                                       *the_case.measurement.front_square_from);
      values["front_square_slope"] = law.slope;
      values["front_square_r2"] = law.r_squared;
    }
    values["budget_defect"] = worst_defect;
    values["mirror_asymmetry"] = worst_asymmetry;
    for(std::size_t i = 0; event_watch && i < cases::n_timed_events; ++i)
      values[cases::timed_event_names[i]]
          = event_watch->time(static_cast<cases::TimedEvent>(i));
    if(the_case.measurement.front_floor > 0)
      values["front_floor"] = the_case.measurement.front_floor;
    return values;
  }
} // namespace meltfront::verification
