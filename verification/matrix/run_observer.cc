#include <cases/error.h>
#include <verification/matrix/end_profile.h>
#include <verification/matrix/run_observer.h>
#include <verification/measure/temperature_error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr int fewest_samples = 50;
    constexpr int samples_of_every_step = 200;

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

  void ErrorStatistics::add(double error)
  {
    if(std::isnan(error))
      return;
    ++count;
    squares += error * error;
    maximum = std::max(maximum, std::abs(error));
  }

  double ErrorStatistics::root_mean_square() const
  {
    return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : nan;
  }

  long ErrorStatistics::samples() const
  {
    return count;
  }

  double ErrorStatistics::largest() const
  {
    return count > 0 ? maximum : nan;
  }

  void FrontCourse::add(double position)
  {
    if(!any)
      first = highest = lowest = position;
    any = true;
    last = position;
    highest = std::max(highest, position);
    lowest = std::min(lowest, position);
    largest_fall = std::max(largest_fall, highest - position);
    largest_rise = std::max(largest_rise, position - lowest);
  }

  double FrontCourse::net_advance() const
  {
    return any ? last - first : nan;
  }

  double FrontCourse::largest_backstep(bool retreats) const
  {
    if(!any)
      return nan;
    return retreats ? largest_rise : largest_fall;
  }

  RunObserver::RunObserver(const cases::Case &c, const cases::Scene &simulated,
                           const std::string &method, cases::Observer *second)
    : the_case(c)
    , scene(simulated)
    , exact(c.exact.get())
    , method(method)
    , second(second)
    , bounds(cases::temperature_bounds(simulated))
    , samples(c.measurement.samples == 0 ? samples_of_every_step : c.measurement.samples)
    , last_time(nan)
    , worst_defect(nan)
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
    reader.emplace(scene, exact, description.spacing, description.smoothing_length);
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
    return the_case.measurement.samples == 0 || sample_is_due(step, time);
  }

  bool RunObserver::wants(long step, double time)
  {
    const bool second_wants = second && second->wants(step, time);
    return wants_itself(step, time) || second_wants;
  }

  void RunObserver::observe(const cases::Snapshot &snapshot)
  {
    if(snapshot.step == last_step)
      return;
    const bool at_the_end = clock(snapshot.time) >= 1 - time_tolerance;
    if(wants_itself(snapshot.step, snapshot.time) || at_the_end)
      measure(snapshot, at_the_end || sample_is_due(snapshot.step, snapshot.time));
    if(at_the_end)
      measure_end(snapshot);
    if(second
       && (second->wants(snapshot.step, snapshot.time) || snapshot.step == 0
           || at_the_end))
      second->observe(snapshot);
    last_step = snapshot.step;
    last_time = snapshot.time;
  }

  void RunObserver::judge(const cases::Snapshot &snapshot, double lowest,
                          double highest) const
  {
    const auto finite = [](double value) { return std::isfinite(value); };
    if(!std::ranges::all_of(snapshot.temperature, finite))
      throw cases::NumericalError(method, snapshot.step, snapshot.time, "temperature",
                                  "is not finite");
    if(!std::ranges::all_of(snapshot.solid_fraction, finite))
      throw cases::NumericalError(method, snapshot.step, snapshot.time, "solid fraction",
                                  "is not finite");
    if(!std::isfinite(snapshot.heat.defect()))
      throw cases::NumericalError(method, snapshot.step, snapshot.time, "heat budget",
                                  "is not finite");
    cases::check_temperature(bounds, lowest, highest, method, snapshot.step,
                             snapshot.time);
  }

  void RunObserver::measure(const cases::Snapshot &snapshot, bool keep)
  {
    const auto [lowest, highest] = std::ranges::minmax(snapshot.temperature);
    judge(snapshot, lowest, highest);
    const FrontReading reading = reader->read(snapshot);
    course.add(reading.latent_heat);
    worst_defect = std::fmax(worst_defect, snapshot.heat.defect());
    if(exact)
      compare_fronts(snapshot, reading);
    if(keep)
      add_to_series(snapshot, reading, lowest, highest);
  }

  void RunObserver::add_to_series(const cases::Snapshot &snapshot,
                                  const FrontReading &reading, double lowest,
                                  double highest)
  {
    next_sample = static_cast<int>(samples * (clock(snapshot.time) + time_tolerance)) + 1;
    run_series.time.push_back(snapshot.time);
    run_series.front.push_back(reading.latent_heat);
    run_series.front_isotherm.push_back(reading.isotherm);
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
    if(std::isnan(reading.max_ice))
      return;
    max_ice.add(reading.max_ice - expected);
    heat_loss.add(reading.heat_loss - expected);
  }

  void RunObserver::measure_end(const cases::Snapshot &snapshot)
  {
    const std::vector<double> &coordinates = reader->coordinates(snapshot);
    end_profile = make_end_profile(snapshot, coordinates, exact, run_description.spacing);
    at_end["front_end_position"] = run_series.front.back();
    at_end["front_row_solid_fraction"] = partly_frozen_fraction(snapshot);
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
  }

  void RunObserver::require_end() const
  {
    if(at_end.empty())
      throw cases::NumericalError(
          method, last_step, last_time, "time",
          fmt::format("was not taken to the end, {:.6g}", scene.end_time));
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

  const std::vector<std::string> &RunObserver::quantity_names()
  {
    static const std::vector<std::string> names{"front_rms",
                                                "front_max",
                                                "front_end",
                                                "front_end_position",
                                                "front_rms_relative",
                                                "front_end_relative",
                                                "front_late_max_relative",
                                                "front_isotherm_rms",
                                                "front_max_ice_rms",
                                                "front_heat_loss_rms",
                                                "front_row_solid_fraction",
                                                "front_backsteps",
                                                "front_floor",
                                                "temperature_l2",
                                                "temperature_max",
                                                "temperature_rmse",
                                                "budget_defect"};
    return names;
  }

  std::map<std::string, double> RunObserver::quantities() const
  {
    const double end = exact ? std::abs(exact->front(scene.end_time)) : nan;
    std::map<std::string, double> values;
    for(const std::string &name : quantity_names())
      values[name] = nan;
    for(const auto &[name, value] : at_end)
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
    const double advance
        = exact ? exact->front(scene.end_time) - exact->front(scene.start_time)
                : course.net_advance();
    values["front_backsteps"] = course.largest_backstep(advance < 0);
    values["budget_defect"] = worst_defect;
    if(the_case.measurement.front_floor > 0)
      values["front_floor"] = the_case.measurement.front_floor;
    return values;
  }
} // namespace meltfront::verification
