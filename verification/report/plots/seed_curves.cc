#include <verification/report/plots/curve_labels.h>
#include <verification/report/plots/plot_data.h>
#include <verification/report/plots/seed_curves.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  Curve mean_over_runs(const Level &level, const SeriesValue &value)
  {
    const RunSeries &first = level.finished->series;
    Curve curve;
    for(std::size_t i = 0; i < first.time.size(); ++i)
    {
      double sum = 0, squares = 0;
      int count = 0;
      for(const RunRecord *run : level.runs)
        if(run->status == RunStatus::finished
           && run->series.time.size() == first.time.size())
        {
          const double one = value(run->series, i);
          sum += one;
          squares += one * one;
          ++count;
        }
      const double mean = sum / count;
      curve.x.push_back(first.time[i]);
      curve.y.push_back(mean);
      curve.spread.push_back(
          count > 1 ? std::sqrt(std::max(0., squares - count * mean * mean) / (count - 1))
                    : 0);
    }
    curve.band = level.finished_count > 1;
    if(!curve.band)
      curve.spread.clear();
    curve.markers = false;
    return curve;
  }

  Plot front_squared_against_time(const CaseRuns &runs, const MethodStyles &styles)
  {
    Plot plot;
    plot.description = "Square of the front against time, " + runs.record->name();
    plot.x.label = with_unit("time", unit_of(*runs.record, "s"));
    plot.y.label = with_unit("square of the front", unit_of(*runs.record, "m²"));
    const auto square = [](const RunSeries &series, const std::size_t i)
    {
      const double front = entry(series.front, i);
      return front * front;
    };
    for(const LabelRuns &label : runs.labels)
    {
      const auto finest
          = std::find_if(label.levels.rbegin(), label.levels.rend(),
                         [](const Level &level) { return level.finished != nullptr; });
      if(finest == label.levels.rend())
        continue;
      Curve curve = mean_over_runs(*finest, square);
      curve.label = label.label;
      curve.style = styles.style(label.label);
      plot.curves.push_back(std::move(curve));
    }
    shorten_labels(plot);
    return plot;
  }
} // namespace meltfront::verification
