#include <cases/numbers.h>
#include <verification/judge/median_course.h>
#include <verification/measure/formulas/run_statistics.h>

#include <algorithm>
#include <map>

namespace meltfront::verification
{
  namespace
  {
    constexpr int n_times = ErrorStatistics::fewest_times;

    bool speaks(const RunRecord &run)
    {
      return run.status == RunStatus::finished && run.series.time.size() > 1
             && run.series.solid_volume.size() == run.series.time.size();
    }

    std::vector<double> volume_at(const RunSeries &series,
                                  const std::vector<double> &times)
    {
      const double tolerance = 1e-9 * (series.time.back() - series.time.front());
      std::vector<double> result;
      for(const double time : times)
        result.push_back(interpolated(series.time, series.solid_volume, time, tolerance));
      return result;
    }

    double median(std::vector<double> values)
    {
      std::ranges::sort(values);
      const std::size_t half = values.size() / 2;
      return values.size() % 2 == 1 ? values[half]
                                    : (values[half - 1] + values[half]) / 2;
    }
  } // namespace

  MedianCourse::MedianCourse(const std::vector<const RunRecord *> &runs)
  {
    std::map<std::string, const RunRecord *> finest;
    for(const RunRecord *run : runs)
      if(speaks(*run))
      {
        const RunRecord *&known = finest[run->method];
        if(!known || run->n > known->n)
          known = run;
      }
    if(finest.empty())
      return;
    const std::vector<double> &of_first = finest.begin()->second->series.time;
    for(int i = 1; i <= n_times; ++i)
      times.push_back(of_first.front()
                      + (of_first.back() - of_first.front()) * i / n_times);
    for(const auto &[method, run] : finest)
      voices.push_back({method, volume_at(run->series, times)});
  }

  int MedianCourse::others(const std::string &method) const
  {
    return static_cast<int>(std::ranges::count_if(voices, [&method](const Voice &voice)
                                                  { return voice.method != method; }));
  }

  std::vector<double> MedianCourse::median_without(const std::string &method) const
  {
    std::vector<double> result;
    for(std::size_t i = 0; i < times.size(); ++i)
    {
      std::vector<double> values;
      for(const Voice &voice : voices)
        if(voice.method != method)
          values.push_back(voice.volume[i]);
      result.push_back(median(values));
    }
    return result;
  }

  double MedianCourse::distance(const RunRecord &run) const
  {
    if(others(run.method) == 0 || !speaks(run))
      return cases::nan;
    const std::vector<double> found = volume_at(run.series, times);
    const std::vector<double> wanted = median_without(run.method);
    ErrorStatistics errors;
    for(std::size_t i = 0; i < times.size(); ++i)
      errors.add(found[i] - wanted[i]);
    return errors.mean_over_time();
  }

  double MedianCourse::course() const
  {
    if(voices.empty())
      return 0;
    const auto [least, largest] = std::ranges::minmax(median_without(""));
    return largest - least;
  }
} // namespace meltfront::verification
