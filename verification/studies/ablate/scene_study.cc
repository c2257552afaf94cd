#include <cases/capabilities.h>
#include <cases/effect_bounds.h>
#include <cases/error.h>
#include <cases/numbers.h>
#include <cases/options.h>
#include <verification/studies/ablate/scene_study.h>
#include <verification/studies/ladders/method_priors.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meltfront::verification
{
  namespace
  {
    constexpr const char *preferred[]
        = {"fem-enthalpy", "sph", "rkpm-tracked", "fem-fitted"};

    int pilot_resolution(const cases::Case &c)
    {
      constexpr int by_dimension[] = {40, 24, 12};
      return by_dimension[c.scene.domain.dimension - 1];
    }

    /** The course of a run's front, NaN while there is one phase only. */
    std::vector<double> fronts(const RunRecord &run, double volume)
    {
      constexpr double trace = 1e-9;
      std::vector<double> course = run.series.front;
      for(std::size_t i = 0; i < course.size(); ++i)
        if(const double solid = run.series.solid_volume[i] / volume;
           solid < trace || solid > 1 - trace)
          course[i] = cases::nan;
      return course;
    }

    double at(const std::vector<double> &times, const std::vector<double> &values,
              double time)
    {
      const auto after = std::ranges::lower_bound(times, time);
      if(after == times.begin())
        return values.front();
      if(after == times.end())
        return values.back();
      const auto i = static_cast<std::size_t>(after - times.begin());
      const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
      return values[i - 1] + share * (values[i] - values[i - 1]);
    }
  } // namespace

  const cases::Method &first_capable(const cases::Case &c,
                                     const std::vector<const cases::Method *> &methods)
  {
    std::vector<const cases::Method *> order;
    for(const char *name : preferred)
      for(const cases::Method *method : methods)
        if(method->name() == name)
          order.push_back(method);
    for(const cases::Method *method : methods)
      if(method->corrected_form().empty()
         && std::ranges::find(order, method) == order.end())
        order.push_back(method);
    const cases::EffectSet effects = cases::effects_within(c.scene, c.effect_tolerance);
    const cases::Scene scene = cases::simulated_scene(c.scene, effects);
    std::string reasons;
    for(const cases::Method *method : order)
      try
      {
        cases::require_capable(*method, scene, effects, 1);
        return *method;
      }
      catch(const cases::Refusal &refusal)
      {
        reasons += fmt::format("{}{}", reasons.empty() ? "" : "; ", refusal.what());
      }
    throw cases::Refusal(
        fmt::format("no method takes the case '{}': {}", c.scene.name, reasons));
  }

  const cases::Method &method_of(const StudySettings &settings, const cases::Case &c)
  {
    if(settings.method.empty())
      return first_capable(c, settings.methods);
    std::vector<std::string> names;
    for(const cases::Method *method : settings.methods)
    {
      if(method->name() == settings.method)
        return *method;
      names.push_back(method->name());
    }
    throw cases::InputError(fmt::format("there is no method '{}'; the nearest is '{}'",
                                        settings.method,
                                        cases::nearest_name(settings.method, names)));
  }

  std::vector<int> three_levels(int n)
  {
    std::vector<int> levels{std::max(2, static_cast<int>(std::lround(n / 2.))),
                            std::max(2, static_cast<int>(std::lround(n / std::sqrt(2.)))),
                            n};
    levels.resize(std::ranges::unique(levels).begin() - levels.begin());
    return levels;
  }

  int resolution_within(const StudySettings &settings, const cases::Case &c,
                        const cases::Method &method, double runs)
  {
    constexpr double most[] = {8, 4, 3};
    const int pilot = pilot_resolution(c);
    Matrix matrix;
    matrix.name = "pilot-" + c.scene.name;
    matrix.title = "Pilot run";
    matrix.time_limit = std::max(1., settings.within);
    matrix.blocks = {{{settings.case_name}, {method.name()}, {pilot}, {}}};
    RunnerOptions options = settings.runner;
    options.progress = nullptr;
    const MatrixResult result = run_matrix(
        matrix, options, settings.load_case,
        [&method](const std::string &) -> const cases::Method & { return method; });
    const RunRecord &run = result.runs.at(0);
    if(run.status == RunStatus::refused)
      throw cases::Refusal(run.message);
    if(run.status == RunStatus::failed)
      throw cases::NumericalError(method.name(), 0, c.scene.start_time, "the pilot run",
                                  "failed: " + run.message);
    const int dimension = run.description.dimension;
    const double factor
        = std::pow(settings.within / (runs * std::max(processor_seconds(run), 1e-3)),
                   1 / method_prior(method.name(), run.description.dimension).growth);
    return static_cast<int>(pilot * std::clamp(factor, 1., most[dimension - 1]));
  }

  double processor_seconds(const RunRecord &run)
  {
    return run.cost.setup_cpu + run.cost.stepping_cpu;
  }

  const RunRecord *find_run(const MatrixResult &result, const std::string &case_name,
                            int n)
  {
    const auto found
        = std::ranges::find_if(result.runs, [&](const RunRecord &run)
                               { return run.case_name == case_name && run.n == n; });
    return found == result.runs.end() ? nullptr : &*found;
  }

  double front_difference(const RunRecord &one, const RunRecord &other, double volume)
  {
    constexpr int times = 96;
    if(one.series.time.empty() || other.series.time.empty())
      return cases::nan;
    const std::vector<double> first = fronts(one, volume), second = fronts(other, volume);
    const double from = std::max(one.series.time.front(), other.series.time.front());
    const double to = std::min(one.series.time.back(), other.series.time.back());
    double sum = 0;
    int count = 0;
    for(int k = 0; k < times; ++k)
    {
      const double time = from + (to - from) * k / (times - 1);
      const double difference
          = at(one.series.time, first, time) - at(other.series.time, second, time);
      if(!std::isfinite(difference))
        continue;
      sum += difference * difference;
      ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : cases::nan;
  }

  double temperature_difference(const RunRecord &one, const RunRecord &other)
  {
    if(one.probes.size() != other.probes.size() || one.probes.empty())
      return cases::nan;
    double sum = 0;
    for(std::size_t i = 0; i < one.probes.size(); ++i)
    {
      const double difference = one.probes[i].temperature - other.probes[i].temperature;
      sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(one.probes.size()));
  }

  double end_front(const RunRecord &run, double volume)
  {
    return run.series.front.empty() ? cases::nan : fronts(run, volume).back();
  }

  double end_volume(const RunRecord &run)
  {
    return run.series.solid_volume.empty() ? cases::nan : run.series.solid_volume.back();
  }
} // namespace meltfront::verification
