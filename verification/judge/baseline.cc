#include <cases/error.h>
#include <cases/numbers.h>
#include <verification/judge/baseline.h>
#include <verification/judge/criteria.h>
#include <verification/judge/refinement.h>
#include <verification/measure/measure.h>
#include <verification/record/json_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;

    const std::vector<std::string> work_counts{"steps", "work", "solver_iterations",
                                               "most_iterations", "capped_steps"};

    /** Errors and counts of work: what is better the smaller it is. */
    const std::vector<std::string> &figure_names()
    {
      static const std::vector<std::string> names = []
      {
        std::vector<std::string> list = work_counts;
        for(const Quantity &quantity : all_quantities())
          if(quantity.error || quantity.name == "budget_defect"
             || (quantity.from_reference && quantity.name.ends_with("_error")))
            list.push_back(quantity.name);
        return list;
      }();
      return names;
    }

    std::string key_of(const RunRecord &run)
    {
      return fmt::format("{}/{}/n={}", run.case_name, run.label, run.n);
    }

    /** 0 for the best. */
    int rank(const std::string &status)
    {
      return status == "finished" || status == "held" ? 0 : status == "refused" ? 1 : 2;
    }

    std::string status_of(const MatrixResult &result, const RunRecord &run)
    {
      for(const StabilityVerdict &verdict : result.stability)
        if(verdict.case_name == run.case_name && verdict.label == run.label
           && verdict.n == run.n)
          return verdict.verdict;
      return to_string(run.status);
    }

    /** A number of so many significant digits as JSON writes it. */
    std::string digits(double value, int count)
    {
      return std::isfinite(value) ? fmt::format("{:.{}g}", value, count) : "null";
    }

    double rounded(double value, int count)
    {
      return std::strtod(fmt::format("{:.{}g}", value, count).c_str(), nullptr);
    }

    constexpr int figure_digits = 4, cost_digits = 2;

    std::string line_of(const BaselineRuns &runs)
    {
      std::string text
          = fmt::format("{{\"status\": {}, \"cpu_seconds\": {}", json(runs.status).dump(),
                        digits(runs.cpu_seconds, cost_digits));
      for(const auto &[name, value] : runs.figures)
        text += fmt::format(", {}: {}", json(name).dump(), digits(value, figure_digits));
      return text + "}";
    }

    std::string line_of(const BaselineCriterion &criterion)
    {
      return fmt::format("[{}, {}, {}, {}, {}]", json(criterion.case_name).dump(),
                         json(criterion.method).dump(), json(criterion.quantity).dump(),
                         digits(criterion.value, figure_digits), criterion.passed);
    }

    std::string words_of(const BaselineCriterion &criterion)
    {
      return criterion.case_name.empty()
                 ? fmt::format("finding '{}'", criterion.quantity)
                 : fmt::format("{}: {}: {}", criterion.case_name, criterion.method,
                               criterion.quantity);
    }

    bool the_same(const BaselineCriterion &a, const BaselineCriterion &b)
    {
      return a.case_name == b.case_name && a.method == b.method
             && a.quantity == b.quantity;
    }

    bool is_among(const BaselineCriterion &criterion,
                  const std::vector<BaselineCriterion> &list)
    {
      return std::ranges::any_of(list, [&criterion](const BaselineCriterion &other)
                                 { return the_same(criterion, other); });
    }

    /** Two bounds on one quantity are one: that holds if both do. */
    void add(Baseline &baseline, const BaselineCriterion &criterion)
    {
      for(BaselineCriterion &other : baseline.criteria)
        if(the_same(other, criterion))
        {
          other.passed = other.passed && criterion.passed;
          return;
        }
      baseline.criteria.push_back(criterion);
    }

    /** Below it a figure says nothing. */
    double floor_of(const MatrixResult &result, const std::string &key,
                    const std::string &name)
    {
      if(std::ranges::find(work_counts, name) != work_counts.end())
        return 0;
      constexpr double margin = 10;
      for(const StoredCase &record : result.cases)
        if(key.starts_with(record.name() + "/"))
          return margin * round_off_floor(record, name);
      return 0;
    }

    /** Collects differences. */
    class Comparing
    {
    public:
      Comparing(const MatrixResult &result, const Baseline &was, double tolerance)
        : result(result)
        , was(was)
        , now(baseline_of(result))
        , tolerance(tolerance)
      {
      }

      BaselineComparison compared()
      {
        for(const auto &[key, before] : was.runs)
          if(const auto found = now.runs.find(key); found != now.runs.end())
            compare(key, before, found->second);
          else
            flag("MISSING", key);
        for(const auto &[key, runs] : now.runs)
          if(!was.runs.contains(key))
            note("new", key);
        for(const BaselineCriterion &before : was.criteria)
          compare(before);
        for(const BaselineCriterion &criterion : now.criteria)
          if(!criterion.passed && !is_among(criterion, was.criteria))
            flag("FAILS",
                 fmt::format("{} = {:.3g}, new", words_of(criterion), criterion.value));
        return comparison;
      }

    private:
      void flag(const char *word, const std::string &text)
      {
        comparison.flags.push_back(fmt::format("{:8} {}", word, text));
      }

      void note(const char *word, const std::string &text)
      {
        comparison.notes.push_back(fmt::format("{:8} {}", word, text));
      }

      void compare(const std::string &key, const BaselineRuns &before,
                   const BaselineRuns &after)
      {
        ++comparison.runs;
        if(rank(after.status) > rank(before.status))
          flag("WORSE", fmt::format("{}: {}, was {}", key, after.status, before.status));
        if(rank(after.status) > 0 || rank(before.status) > 0)
          return;
        for(const auto &[name, old] : before.figures)
          if(const auto found = after.figures.find(name); found != after.figures.end())
            compare(key, name, old, found->second);
          else
            flag("MISSING", fmt::format("{} {}", key, name));
      }

      void compare(const std::string &key, const std::string &name, double old,
                   double value)
      {
        ++comparison.figures;
        const double floor = floor_of(result, key, name);
        const double from = std::max(old, floor), to = std::max(value, floor);
        const std::string text = fmt::format(
            "{} {}: {:.4g} -> {:.4g}{}", key, name, old, value,
            old > 0 ? fmt::format(" ({:+.0f} %)", 100 * (value / old - 1)) : "");
        if(to > (1 + tolerance) * from)
          flag("GREW", text);
        else if(from > (1 + tolerance) * to)
          note("fell", text);
      }

      void compare(const BaselineCriterion &before)
      {
        ++comparison.criteria;
        const auto found
            = std::ranges::find_if(now.criteria, [&](const BaselineCriterion &criterion)
                                   { return the_same(before, criterion); });
        if(found == now.criteria.end())
          flag("MISSING", words_of(before));
        else if(before.passed && !found->passed)
          flag("FAILS", fmt::format("{} = {:.3g}, held with {:.3g}", words_of(before),
                                    found->value, before.value));
      }

      const MatrixResult &result;
      const Baseline &was;
      Baseline now;
      double tolerance;
      BaselineComparison comparison;
    };
  } // namespace

  Baseline baseline_of(const MatrixResult &result)
  {
    Baseline baseline{result.name, result.program_version, {}, {}};
    for(const RunRecord &run : result.runs)
    {
      const auto [at, is_new] = baseline.runs.try_emplace(key_of(run));
      BaselineRuns &runs = at->second;
      const std::string status = status_of(result, run);
      if(is_new || rank(status) > rank(runs.status))
        runs.status = status;
      const double seconds = table_value(run, "cpu_seconds");
      runs.cpu_seconds += std::isfinite(seconds) ? seconds : 0;
      for(const std::string &name : figure_names())
        if(const double value = std::abs(table_value(run, name)); std::isfinite(value))
        {
          const auto figure = runs.figures.try_emplace(name, 0).first;
          figure->second = std::max(figure->second, rounded(value, figure_digits));
        }
    }
    for(const CriterionResult &criterion : result.criteria)
      add(baseline, {criterion.case_name, criterion.method, criterion.quantity,
                     criterion.value, criterion.passed});
    for(const FindingResult &finding : result.findings)
      add(baseline, {"", "", finding.claim, cases::nan, finding.holds()});
    std::ranges::stable_sort(baseline.criteria, {},
                             [](const BaselineCriterion &criterion) {
                               return std::tuple(criterion.case_name, criterion.method,
                                                 criterion.quantity);
                             });
    return baseline;
  }

  void write_baseline(const std::string &path, const Baseline &baseline)
  {
    std::string runs, criteria;
    for(const auto &[key, of_key] : baseline.runs)
      runs += fmt::format("{}\n  {}: {}", runs.empty() ? "" : ",", json(key).dump(),
                          line_of(of_key));
    for(const BaselineCriterion &criterion : baseline.criteria)
      criteria
          += fmt::format("{}\n  {}", criteria.empty() ? "" : ",", line_of(criterion));
    write_atomically(path,
                     fmt::format("{{\n \"matrix\": {},\n \"program_version\": {},\n "
                                 "\"criteria\": [{}\n ],\n \"runs\": {{{}\n }}\n}}\n",
                                 json(baseline.matrix).dump(),
                                 json(baseline.program_version).dump(), criteria, runs));
  }

  Baseline read_baseline(const std::string &path)
  {
    const json stored = read_json(path);
    try
    {
      Baseline baseline{stored.at("matrix"), stored.at("program_version"), {}, {}};
      for(const auto &[key, line] : stored.at("runs").items())
      {
        BaselineRuns runs;
        for(const auto &[name, value] : line.items())
          if(name == "status")
            runs.status = value;
          else if(name == "cpu_seconds")
            runs.cpu_seconds = number_in(value);
          else
            runs.figures[name] = number_in(value);
        baseline.runs[key] = std::move(runs);
      }
      for(const json &line : stored.at("criteria"))
        baseline.criteria.push_back(
            {line.at(0), line.at(1), line.at(2), number_in(line.at(3)), line.at(4)});
      return baseline;
    }
    catch(const json::exception &error)
    {
      throw cases::OutputError(fmt::format("{} does not hold the figures of a matrix: {}",
                                           path, error.what()));
    }
  }

  BaselineComparison compare_with_baseline(const MatrixResult &result,
                                           const Baseline &was, double tolerance)
  {
    return Comparing(result, was, tolerance).compared();
  }

  std::string comparison_text(const BaselineComparison &comparison)
  {
    std::string text;
    for(const auto *lines : {&comparison.flags, &comparison.notes})
      for(const std::string &line : *lines)
        text += fmt::format("  {}\n", line);
    return text
           + fmt::format("{} figures of {} runs and {} criteria compared: {} flagged\n",
                         comparison.figures, comparison.runs, comparison.criteria,
                         comparison.flags.size());
  }
} // namespace meltfront::verification
