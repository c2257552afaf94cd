#include <verification/app/console.h>
#include <verification/judge/criteria.h>
#include <verification/judge/reference.h>
#include <verification/judge/refinement.h>

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace meltfront::verification
{
  namespace
  {
    /** Labels of a case's runs, in the matrix's order. */
    std::vector<std::string> labels_of(const MatrixResult &result,
                                       const std::string &case_name)
    {
      std::vector<std::string> labels;
      for(const RunRecord &run : result.runs)
        if(run.case_name == case_name
           && std::find(labels.begin(), labels.end(), run.label) == labels.end())
          labels.push_back(run.label);
      return labels;
    }

    /** What a table shows first of a case: the front's error, or the solid's from the
     * reference. */
    struct FirstColumn
    {
      const char *name;
      const char *words;
    };

    FirstColumn first_column(const StoredCase &record,
                             const std::vector<const RunRecord *> &finished)
    {
      if(record.scene.problem == cases::ProblemKind::interface_advection)
        return {"shape_mismatch_end", "mismatch, end"};
      if(!record.scene.conducts_heat())
        return {"solid_end", "solid particles"};
      if(!record.exact && record.reference)
        return {"solid_volume_end_error", "solid, end"};
      if(!record.scene.changes_phase())
        return {"temperature_rmse", "temperature rmse"};
      // Few steps have no root mean square.
      const bool all = std::none_of(finished.begin(), finished.end(),
                                    [](const RunRecord *run) {
                                      return std::isnan(table_value(*run, "front_rms"));
                                    });
      return all ? FirstColumn{"front_rms", "front rms"}
                 : FirstColumn{"front_end", "front end"};
    }

    double mean_over(const std::vector<const RunRecord *> &runs, const char *quantity)
    {
      double sum = 0;
      for(const RunRecord *run : runs)
        sum += table_value(*run, quantity);
      return sum / static_cast<double>(runs.size());
    }

    std::string measured_text(const StoredCase &record,
                              const std::vector<const RunRecord *> &finished,
                              const RunRecord &finest)
    {
      const FirstColumn column = first_column(record, finished);
      if(record.scene.problem == cases::ProblemKind::particle_solid)
        return fmt::format("{:.1f} particles solid at the end, mean of {}",
                           mean_over(finished, column.name), finished.size());
      if(is_reference(record, finest))
        return "the reference";
      const double error = table_value(finest, column.name);
      if(std::isnan(error))
        return !record.exact ? "no exact solution" : "no error";
      const Refinement refinement(finished);
      ErrorLevels levels;
      for(const RunRecord *run : finished)
        if(!is_reference(record, *run))
        {
          levels.abscissa.push_back(refinement.of(*run));
          levels.error.push_back(table_value(*run, column.name));
        }
      return fmt::format("{} {:9.2e}   {}", column.words, error,
                         levels.error.size() > 1
                             ? fit_levels(levels, record, column.name, finest, refinement)
                                   .text(refinement.symbol())
                             : "");
    }

    std::string convergence_line(const MatrixResult &result, const StoredCase &record,
                                 const std::string &label)
    {
      std::vector<const RunRecord *> finished;
      const RunRecord *finest = nullptr;
      std::string message;
      for(const RunRecord &run : result.runs)
      {
        if(run.case_name != record.name() || run.label != label)
          continue;
        if(run.status != RunStatus::finished)
        {
          message = run.message;
          continue;
        }
        finished.push_back(&run);
        if(finest == nullptr || run.n > finest->n)
          finest = &run;
      }
      if(finest == nullptr)
        return fmt::format("  {:22} no result: {}\n", label, message);
      return fmt::format("  {:28} n = {:<5} {:50} {:8.2f} s CPU\n", label, finest->n,
                         measured_text(record, finished, *finest),
                         table_value(*finest, "cpu_seconds"));
    }

    enum class Colour
    {
      good = 32, // green
      bad = 31   // red
    };

    std::string coloured(const std::string &words, Colour colour)
    {
      static const bool terminal
          = isatty(fileno(stdout)) && std::getenv("NO_COLOR") == nullptr;
      return terminal ? fmt::format("\033[{}m{}\033[0m", static_cast<int>(colour), words)
                      : words;
    }

    std::string coloured(bool good, const char *if_good, const char *if_bad)
    {
      return coloured(good ? if_good : if_bad, good ? Colour::good : Colour::bad);
    }

    std::string bound_text(const CriterionResult &criterion)
    {
      if(!std::isfinite(criterion.lower))
        return fmt::format("<= {:.3g}", criterion.upper);
      if(!std::isfinite(criterion.upper))
        return fmt::format(">= {:.3g}", criterion.lower);
      return fmt::format("in {:.4g} .. {:.4g}", criterion.lower, criterion.upper);
    }

    std::string criterion_line(const CriterionResult &criterion)
    {
      return fmt::format("  {}  {}: {}: {} = {:.3g}, {}{}{}\n",
                         coloured(criterion.passed, "PASS", "FAIL"), criterion.case_name,
                         criterion.method, criterion.quantity, criterion.value,
                         bound_text(criterion),
                         criterion.remark.empty() ? "" : "; " + criterion.remark,
                         criterion.expected_failure.empty()
                             ? ""
                             : "; expected failure: " + criterion.expected_failure);
    }

    std::string finding_line(const FindingResult &finding)
    {
      return fmt::format("  {}  {}\n", coloured(finding.holds(), "HOLDS", "FAILS"),
                         claim_text(finding));
    }

    /** The verdict, and what does not hold. */
    std::string verdict_text(const MatrixResult &result)
    {
      std::string failures;
      for(const CriterionResult &criterion : result.criteria)
        if(!criterion.passed)
          failures += criterion_line(criterion);
      for(const FindingResult &finding : result.findings)
        if(!finding.holds())
          failures += finding_line(finding);
      const auto held = std::ranges::count_if(result.criteria, &CriterionResult::passed);
      return fmt::format(
                 "{}: {}{}\n", result.name, coloured(result.passed, "PASSED", "FAILED"),
                 result.criteria.empty() ? ""
                                         : fmt::format(", {} of {} criteria hold", held,
                                                       result.criteria.size()))
             + failures;
    }

    /** The varied cases, which have too many rows for a terminal. */
    std::string variations_text(const MatrixResult &result)
    {
      std::map<std::string, int> count;
      for(const StoredCase &c : result.cases)
        if(!c.variation.empty())
          ++count[c.variation_of];
      std::string text;
      for(const auto &[name, variations] : count)
        text += fmt::format("{}: {} variations, in the report\n", name, variations);
      return text;
    }

    std::string stability_text(const MatrixResult &result)
    {
      std::map<std::string, int> count;
      std::string text;
      for(const StabilityVerdict &verdict : result.stability)
      {
        ++count[verdict.verdict];
        if(verdict.verdict != "held")
          text
              += fmt::format("  {:8} {} {} n = {}: {}\n", verdict.verdict,
                             verdict.case_name, verdict.label, verdict.n, verdict.reason);
      }
      return fmt::format("Hard cases: {} held, {} caught, {} refused, {} failed\n",
                         count["held"], count["caught"], count["refused"],
                         count["failed"])
             + text;
    }
    /** What a method counted of its own doings; empty if nothing. */
    std::string evidence_line(const cases::Cost &cost)
    {
      std::string text;
      for(const auto &[name, value] : cost.evidence)
        text += fmt::format("{}{}: {:.3g}", text.empty() ? "Evidence: " : "; ", name,
                            value);
      return text.empty() ? "" : text + "\n";
    }

    /** What was left out; criteria without a run, of which small matrices have many, are
     * counted. */
    std::string omissions_text(const MatrixResult &result)
    {
      std::string text;
      int without_run = 0;
      for(const std::string &omission : result.omissions)
        if(omission.ends_with("not judged: the matrix has no such run"))
          ++without_run;
        else if(!result.hard_cases) // whose verdicts name every refusal and failure
          text += fmt::format("Left out: {}\n", omission);
      if(without_run > 0)
        text += fmt::format(
            "Not judged: {} criteria of these cases, whose runs the matrix "
            "lacks (the report lists them)\n",
            without_run);
      return text;
    }

    /** What the harness asked of all snapshots: the worst value and its bound. */
    std::string checks_text(const RunRecord &record)
    {
      std::string text = record.checks.empty() ? "" : "Checks:\n";
      for(const Check &check : record.checks)
        text += fmt::format("  {:24} {:.2g}, {} {:.2g}\n", check.name, check.value,
                            check.passed ? "within" : "MORE THAN", check.bound);
      for(const auto &[name, reason] : record.unchecked)
        text += fmt::format("  {:24} not checked: {}\n", name, reason);
      return text;
    }
  } // namespace

  std::string console_summary(const MatrixResult &result, bool details)
  {
    std::string text = verdict_text(result);
    if(result.hard_cases)
      text += stability_text(result);
    std::string lines;
    for(const StoredCase &c : result.cases)
    {
      if(!c.variation.empty())
        continue;
      lines += fmt::format("{}\n", c.name());
      for(const std::string &label : labels_of(result, c.name()))
        lines += convergence_line(result, c, label);
    }
    if(lines.find(" +- ") != std::string::npos)
      lines += "Orders: +- is the half width of the 95 % confidence interval (Student's "
               "t).\n";
    text += lines + variations_text(result);
    if(!details)
      return text
             + (result.omissions.empty()
                    ? ""
                    : fmt::format("{} remarks on what was left out or not judged: -v\n",
                                  result.omissions.size()));
    if(!result.criteria.empty())
      text += "Criteria:\n";
    for(const CriterionResult &criterion : result.criteria)
      text += criterion_line(criterion);
    if(!result.findings.empty())
      text += "Findings:\n";
    for(const FindingResult &finding : result.findings)
      text += finding_line(finding);
    return text + omissions_text(result);
  }

  std::string run_text(const RunRecord &record, const cases::Case &c)
  {
    std::string text = fmt::format(
        "{} by {}, n = {}: {}\n", c.scene.name, record.label, record.n,
        record.status == RunStatus::finished
            ? "finished"
            : fmt::format("{}: {}", to_string(record.status), record.message));
    for(const cases::Parameter &parameter : record.description.parameters)
      text += fmt::format("  {:28} {} {}\n", parameter.name, parameter.value,
                          parameter.unit);
    text += "Effects:\n";
    const double total = record.cost.setup_wall + record.cost.stepping_wall;
    for(const cases::EffectDecision &decision : record.effects)
    {
      std::string cost;
      for(const cases::EffectCost &effect : record.cost.effects)
        if(effect.effect == decision.effect)
          cost = fmt::format("; {:.1f} % of the time, {} bytes, {} calls",
                             total > 0 ? 100 * effect.seconds / total : 0., effect.bytes,
                             effect.calls);
      text += fmt::format("  {:20} {:3}  {}{}\n", to_string(decision.effect),
                          decision.on ? "on" : "off", decision.reason, cost);
    }
    for(const RunEvent &event : record.events)
      text += fmt::format("At t = {:.6g}: {}\n", event.time, event.what);
    text += checks_text(record);
    if(record.status != RunStatus::finished)
      return text;
    text += evidence_line(record.cost);
    text += "Results:\n";
    for(const auto &[name, value] : record.quantities)
      if(std::isfinite(value))
        text += fmt::format("  {:24} {:.4g}\n", name, value);
    text += fmt::format(
        "Cost: {:.3f} s CPU stepping, {:.3f} s set-up, {} steps, {} unknowns, "
        "{} entries touched, {:.0f} MB\n",
        record.cost.stepping_cpu, record.cost.setup_cpu, record.cost.steps,
        record.cost.unknowns, record.cost.work, record.peak_memory_mb);
    return text;
  }
} // namespace meltfront::verification
