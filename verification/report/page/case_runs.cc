#include <verification/judge/answers.h>
#include <verification/judge/criteria.h>
#include <verification/judge/reference.h>
#include <verification/judge/refinement.h>
#include <verification/report/page/case_runs.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

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

  int LabelRuns::dimension() const
  {
    const RunRecord *run = finest();
    return (run ? run : levels.back().runs.back())->description.dimension;
  }

  ErrorLevels LabelRuns::errors(const std::string &quantity) const
  {
    ErrorLevels result;
    const std::string abscissa = refinement.symbol();
    for(const Level &level : levels)
      if(std::isfinite(level.value(quantity)) && level.value(abscissa) > 0)
      {
        result.abscissa.push_back(level.value(abscissa));
        result.error.push_back(level.value(quantity));
      }
    return result;
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
      for(const auto &[name, value] : run_columns(run))
        values[name] = value;
      if(run.cost.unknowns == 0)
        values["unknowns"] = static_cast<double>(run.description.unknowns);
      for(const char *name : {"h", "dt", "unknowns", "peak_memory_mb"})
        if(!(values[name] > 0))
          values[name] = std::nan("");
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
        result.count = static_cast<int>(list.size());
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

    void add_consensus_errors(CaseRuns &runs, const MatrixResult &result)
    {
      for(const LevelError &error : level_errors(result, *runs.record))
        for(LabelRuns &label : runs.labels)
          for(Level &level : label.levels)
            if(label.label == error.label && level.n == error.n)
              level.values["consensus_error"] = {error.error, 0, 1};
    }
  } // namespace

  CaseRuns collect_runs(const MatrixResult &result, const StoredCase &record)
  {
    CaseRuns collected;
    collected.record = &record;
    for(const RunRecord &run : result.runs)
    {
      if(run.case_name != record.name())
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
      std::vector<const RunRecord *> runs;
      for(Level &level : label.levels)
      {
        average(level);
        runs.insert(runs.end(), level.runs.begin(), level.runs.end());
      }
      label.refinement = Refinement(runs);
    }
    return collected;
  }

  std::vector<CaseRuns> collect_runs(const MatrixResult &result)
  {
    std::vector<CaseRuns> all;
    for(const StoredCase &record : result.cases)
      all.push_back(collect_runs(result, record));
    if(all.size() == 1 && !all.front().record->exact
       && !std::isfinite(main_error_scale(all.front())))
      add_consensus_errors(all.front(), result);
    return all;
  }

  bool radial_front(const StoredCase &record)
  {
    cases::Symmetry symmetry = record.scene.symmetry;
    if(symmetry == cases::Symmetry::none)
      symmetry = record.exact ? record.exact->symmetry() : cases::Symmetry::planar;
    return symmetry != cases::Symmetry::planar;
  }

  bool moves_particles(const StoredCase &record)
  {
    return record.scene.problem == cases::ProblemKind::particle_solid;
  }

  bool carries_front(const StoredCase &record)
  {
    return record.scene.problem == cases::ProblemKind::interface_advection;
  }

  bool steady(const StoredCase &record)
  {
    return record.scene.problem == cases::ProblemKind::poisson;
  }

  double exact_front_at_end(const StoredCase &record)
  {
    return record.exact ? record.exact->front(record.scene.end_time) : std::nan("");
  }

  double front_size_at_end(const StoredCase &record)
  {
    const double front = std::abs(exact_front_at_end(record));
    if(std::isfinite(front) || !record.exact)
      return front;
    const double volume = record.exact->solid_volume(record.scene.end_time);
    return measure_dimension(record) == 3 ? std::cbrt(3 * volume / (4 * std::numbers::pi))
                                          : std::sqrt(volume / std::numbers::pi);
  }

  std::string main_error(const StoredCase &record)
  {
    if(!record.scene.conducts_heat())
      return carries_front(record) ? "shape_mismatch_end" : "energy_error";
    if(!record.scene.changes_phase())
      return "temperature_rmse";
    return !record.exact ? "solid_volume_end_error" : "front_rms";
  }

  std::vector<int> dimensions_of(const CaseRuns &runs)
  {
    std::set<int> dimensions;
    for(const LabelRuns &label : runs.labels)
      dimensions.insert(label.dimension());
    return {dimensions.begin(), dimensions.end()};
  }

  std::string main_error(const CaseRuns &runs)
  {
    constexpr const char *consensus = "consensus_error";
    return runs.has(consensus) ? consensus : main_error(*runs.record);
  }

  double shown_error(const Level &level, const CaseRuns &runs)
  {
    const std::string name = main_error(runs);
    const double error = level.value(name);
    return name == "front_rms" && std::isnan(error) ? level.value("front_max") : error;
  }

  double main_error_scale(const CaseRuns &runs)
  {
    if(main_error(runs) != main_error(*runs.record))
      return 1;
    if(moves_particles(*runs.record))
      return std::nan(""); // nothing is known that it could be relative to
    if(!runs.record->scene.changes_phase())
      return 1; // errors of temperatures and shapes are relative
    if(runs.record->exact)
      return front_size_at_end(*runs.record);
    for(const LabelRuns &label : runs.labels)
      for(const Level &level : label.levels)
        if(level.finished && is_reference(*runs.record, *level.finished))
          return std::abs(level.value("solid_volume_end"));
    return std::nan("");
  }

  std::string restated(const StoredCase &record, const std::string &figure)
  {
    const auto found = record.printed_figures.find(figure);
    return found == record.printed_figures.end()
               ? std::string()
               : fmt::format(" Restates {}.", found->second);
  }

  std::string volume_unit(const StoredCase &record)
  {
    constexpr const char *units[] = {"m", "m²", "m³"};
    return units[measure_dimension(record) - 1];
  }

  std::string unit_of(const StoredCase &record, const std::string &unit)
  {
    return record.scene.units == "SI" ? unit : "";
  }
} // namespace meltfront::verification
