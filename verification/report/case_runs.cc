#include <verification/report/case_runs.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  double Level::value(const std::string &quantity) const
  {
    const auto found = values.find(quantity);
    return found == values.end() ? std::nan("") : found->second.mean;
  }

  double Level::spread(const std::string &quantity) const
  {
    const auto found = values.find(quantity);
    return found == values.end() ? 0 : found->second.spread;
  }

  std::string Level::status() const
  {
    const int all = static_cast<int>(runs.size());
    if(finished_count == all)
      return "finished";
    if(finished_count > 0)
      return fmt::format("{} of {} finished", finished_count, all);
    const bool failed = std::any_of(runs.begin(), runs.end(),
                                    [](const RunRecord *run)
                                    { return run->status == RunStatus::failed; });
    return failed ? "failed" : "refused";
  }

  const RunRecord *LabelRuns::finest() const
  {
    for(auto level = levels.rbegin(); level != levels.rend(); ++level)
      if(level->finished)
        return level->finished;
    return nullptr;
  }

  void LabelRuns::finite_values(const std::string &quantity, std::vector<double> &h,
                                std::vector<double> &values) const
  {
    for(const Level &level : levels)
      if(std::isfinite(level.value(quantity)) && level.value("h") > 0)
      {
        h.push_back(level.value("h"));
        values.push_back(level.value(quantity));
      }
  }

  const LabelRuns *CaseRuns::find(const std::string &label) const
  {
    const auto found
        = std::find_if(labels.begin(), labels.end(),
                       [&label](const LabelRuns &runs) { return runs.label == label; });
    return found == labels.end() ? nullptr : &*found;
  }

  const RunRecord *CaseRuns::finest() const
  {
    const RunRecord *best = nullptr;
    for(const LabelRuns &runs : labels)
    {
      const RunRecord *run = runs.finest();
      if(run && !run->series.front.empty() && std::isfinite(run->series.front.back())
         && (!best || run->n > best->n))
        best = run;
    }
    return best;
  }

  bool CaseRuns::has(const std::string &quantity) const
  {
    for(const LabelRuns &runs : labels)
      for(const Level &level : runs.levels)
        if(std::isfinite(level.value(quantity)))
          return true;
    return false;
  }

  double cpu_seconds(const RunRecord &run)
  {
    return run.cost.setup_cpu + run.cost.stepping_cpu;
  }

  namespace
  {
    std::map<std::string, double> all_values(const RunRecord &run)
    {
      std::map<std::string, double> values = run.quantities;
      const auto positive = [](double value) { return value > 0 ? value : std::nan(""); };
      values["h"] = positive(run.description.spacing);
      values["unknowns"] = positive(static_cast<double>(
          run.cost.unknowns > 0 ? run.cost.unknowns : run.description.unknowns));
      values["steps"] = static_cast<double>(run.cost.steps);
      values["cpu_seconds"] = cpu_seconds(run);
      values["wall_seconds"] = run.cost.setup_wall + run.cost.stepping_wall;
      values["peak_memory_mb"] = positive(run.peak_memory_mb);
      values["work"] = static_cast<double>(run.cost.work);
      return values;
    }

    void average(Level &level)
    {
      std::map<std::string, std::vector<double>> samples;
      for(const RunRecord *run : level.runs)
      {
        if(run->status != RunStatus::finished)
          continue;
        ++level.finished_count;
        if(!level.finished)
          level.finished = run;
        for(const auto &[name, value] : all_values(*run))
          if(std::isfinite(value))
            samples[name].push_back(value);
      }
      for(const auto &[name, list] : samples)
      {
        SeedMean &result = level.values[name];
        for(const double value : list)
          result.mean += value / list.size();
        double squares = 0;
        for(const double value : list)
          squares += (value - result.mean) * (value - result.mean);
        if(list.size() > 1)
          result.spread = std::sqrt(squares / (list.size() - 1));
      }
    }

    template <typename List, typename Matches>
    auto &find_or_add(List &list, const Matches &matches)
    {
      const auto found = std::find_if(list.begin(), list.end(), matches);
      return found == list.end() ? list.emplace_back() : *found;
    }
  } // namespace

  CaseRuns collect_runs(const MatrixResult &result, const CaseRecord &record)
  {
    CaseRuns collected;
    collected.record = &record;
    for(const RunRecord &run : result.runs)
    {
      if(run.case_name != record.name)
        continue;
      LabelRuns &label = find_or_add(collected.labels, [&run](const LabelRuns &candidate)
                                     { return candidate.label == run.label; });
      label.label = run.label;
      Level &level = find_or_add(label.levels, [&run](const Level &candidate)
                                 { return candidate.n == run.n; });
      level.n = run.n;
      level.runs.push_back(&run);
    }
    for(LabelRuns &label : collected.labels)
    {
      std::sort(label.levels.begin(), label.levels.end(),
                [](const Level &a, const Level &b) { return a.n < b.n; });
      for(Level &level : label.levels)
        average(level);
    }
    return collected;
  }

  std::vector<CaseRuns> collect_runs(const MatrixResult &result)
  {
    std::vector<CaseRuns> all;
    for(const CaseRecord &record : result.cases)
      all.push_back(collect_runs(result, record));
    return all;
  }

  double domain_side(const CaseRecord &record)
  {
    return record.shape == "ball" ? 2 * record.radius : record.upper[0] - record.lower[0];
  }

  std::string method_of(const std::string &label)
  {
    return label.substr(0, label.find('['));
  }

  bool radial_front(const CaseRecord &record)
  {
    if(record.symmetry == "none")
      return !record.exact.empty() && !record.exact.starts_with("planar");
    return record.symmetry != "planar";
  }

  std::string unit_of(const CaseRecord &record, const std::string &unit)
  {
    return record.units == "SI" ? unit : "";
  }
} // namespace meltfront::verification
