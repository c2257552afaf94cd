#include <verification/report/pictures/tracked_front.h>
#include <verification/report/plots/gnuplot.h>

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  const RunRecord *tracked_run(const CaseRuns &runs)
  {
    const RunRecord *best = nullptr;
    for(const LabelRuns &label : runs.labels)
      if(const RunRecord *run = label.finest();
         run && !run->frames.empty()
         && (!best || run->frames.back().x.size() > best->frames.back().x.size()))
        best = run;
    return best;
  }

  std::vector<std::string> write_tracked_fronts(std::string &script,
                                                const std::vector<FrontFrame> &frames)
  {
    std::vector<std::string> plots;
    const auto out = std::back_inserter(script);
    for(std::size_t f = 0; f < frames.size(); ++f)
    {
      const bool last = f + 1 == frames.size();
      int points = 0;
      std::string data;
      for(std::size_t i = 0; i < frames[f].x.size(); ++i)
        if(std::isfinite(frames[f].x[i]) && std::isfinite(frames[f].y[i]))
        {
          fmt::format_to(std::back_inserter(data), "{:.6g} {:.6g}\n", frames[f].x[i],
                         frames[f].y[i]);
          ++points;
        }
      if(points == 0)
        continue;
      fmt::format_to(out, "$tracked{} << end_of_data\n{}end_of_data\n", f, data);
      plots.push_back(fmt::format("$tracked{} with points pt 7 ps {} lc rgb '{}'", f,
                                  last ? 0.42 : 0.34,
                                  last ? "black" : plot_colours::axis));
    }
    return plots;
  }
} // namespace meltfront::verification
