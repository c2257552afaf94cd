#include <verification/report/tables/cost_at_error.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    bool positive(double value)
    {
      return std::isfinite(value) && value > 0;
    }
  } // namespace

  CostAtError cost_at_error(const WorkPrecision &measured, double wanted)
  {
    WorkPrecision levels;
    for(std::size_t i = 0; i < measured.error.size(); ++i)
      if(positive(measured.error[i]) && positive(measured.cost[i]))
      {
        levels.error.push_back(measured.error[i]);
        levels.cost.push_back(measured.cost[i]);
      }
    std::size_t first = levels.error.size();
    while(first > 0 && levels.error[first - 1] <= wanted)
      --first;
    if(first == levels.error.size())
      return {};
    if(first == 0)
      return {Reach::coarsest, levels.cost[0], {}};
    const double coarse = std::log(levels.error[first - 1]);
    const double fine = std::log(levels.error[first]);
    const double share = (coarse - std::log(wanted)) / (coarse - fine);
    return {Reach::interpolated,
            std::exp((1 - share) * std::log(levels.cost[first - 1])
                     + share * std::log(levels.cost[first])),
            {}};
  }

  WorkPrecision relative_work_precision(const LabelRuns &label, const CaseRuns &runs)
  {
    WorkPrecision result;
    const double scale = main_error_scale(runs);
    if(!positive(scale))
      return result;
    for(const Level &level : label.levels)
    {
      const double error = shown_error(level, runs), cost = level.value("cpu_seconds");
      if(positive(error) && positive(cost))
      {
        result.error.push_back(error / scale);
        result.cost.push_back(cost);
      }
    }
    return result;
  }

  bool has_relative_error(const CaseRuns &runs)
  {
    return std::any_of(runs.labels.begin(), runs.labels.end(),
                       [&runs](const LabelRuns &label)
                       { return !relative_work_precision(label, runs).error.empty(); });
  }

  CostAtError cheapest(const CaseRuns &runs, double wanted)
  {
    CostAtError best;
    for(const LabelRuns &label : runs.labels)
    {
      CostAtError found = cost_at_error(relative_work_precision(label, runs), wanted);
      found.label = label.label;
      if(found.reach != Reach::not_reached
         && (best.reach == Reach::not_reached || found.cost < best.cost))
        best = found;
    }
    return best;
  }
} // namespace meltfront::verification
