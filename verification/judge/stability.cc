#include <verification/judge/stability.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr double largest_defect = 1e-12;
    constexpr double largest_backstep = 1e-9; // of the domain's side

    bool beyond_limit(const RunRecord &run)
    {
      const auto factor = run.options.find("step_factor");
      return factor != run.options.end() && std::stod(factor->second) > 1;
    }

    bool finite(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(),
                         [](double value) { return std::isfinite(value); });
    }

    /** Why a finished run does not count as held; empty if it does. */
    std::string reason_not_held(const RunRecord &run, const StoredCase &record)
    {
      if(beyond_limit(run))
        return "a step beyond the stability limit was returned as a result";
      const RunSeries &series = run.series;
      if(series.time.empty() || !finite(series.front) || !finite(series.temperature_min)
         || !finite(series.temperature_max))
        return "front or temperature is not finite";
      const double defect = run.quantity("budget_defect");
      if(!(defect <= largest_defect))
        return fmt::format("heat budget defect {:.2e} exceeds {:.0e}", defect,
                           largest_defect);
      const double backstep = run.quantity("front_backsteps");
      if(record.measurement.monotone_front
         && !(backstep <= largest_backstep * record.scene.domain.side()))
        return fmt::format("the front moved back by {:.2e} m", backstep);
      return {};
    }

    StabilityVerdict judge(const RunRecord &run, const StoredCase &record)
    {
      StabilityVerdict verdict{run.case_name, run.label, run.n, "held", ""};
      if(run.status == RunStatus::refused)
        verdict.verdict = run.message.empty() ? "failed" : "refused";
      else if(run.status == RunStatus::failed)
        verdict.verdict
            = beyond_limit(run) && !run.message.empty() ? "refused" : "failed";
      verdict.reason = run.message;
      if(run.status == RunStatus::finished)
      {
        verdict.reason = reason_not_held(run, record);
        if(!verdict.reason.empty())
          verdict.verdict = "failed";
      }
      return verdict;
    }
  } // namespace

  std::vector<StabilityVerdict> judge_stability(const MatrixResult &result)
  {
    std::vector<StabilityVerdict> verdicts;
    for(const RunRecord &run : result.runs)
    {
      const auto record = std::find_if(result.cases.begin(), result.cases.end(),
                                       [&run](const StoredCase &c)
                                       { return c.name() == run.case_name; });
      if(record != result.cases.end())
        verdicts.push_back(judge(run, *record));
    }
    return verdicts;
  }
} // namespace meltfront::verification
