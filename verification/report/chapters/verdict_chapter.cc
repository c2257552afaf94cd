#include <verification/report/chapters/chapters.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace meltfront::verification
{
  std::vector<std::string> ReportContext::labels() const
  {
    std::vector<std::string> list;
    for(const RunRecord &run : result.runs)
      if(std::find(list.begin(), list.end(), run.label) == list.end())
        list.push_back(run.label);
    return list;
  }

  std::string case_anchor(const std::string &name)
  {
    return "case-" + plain_name(name);
  }

  Markup case_link(const std::string &name)
  {
    return element("a",
                   {{"href", fmt::format("#{}", case_anchor(name))}, {"class", "case"}},
                   text(name));
  }

  Markup badge(const std::string &kind, const std::string &words)
  {
    return element("span", {{"class", "badge " + kind}}, text(words));
  }

  Markup linked_csv(const ReportContext &context, const std::string &name,
                    const std::string &csv)
  {
    const std::string file = "tables/" + plain_name(name) + ".csv";
    write_file(context.directory + "/" + file, csv);
    return element("p", {{"class", "links"}},
                   element("a",
                           {{"href", data_address("text/csv", csv)},
                            {"download", plain_name(name) + ".csv"}},
                           text("CSV"))
                       + text(" (in this page; also ")
                       + element("a", {{"href", file}}, text(file)) + text(")"));
  }

  Markup bound_of(const CriterionResult &criterion, int digits)
  {
    const bool below = std::isfinite(criterion.upper);
    const bool above = std::isfinite(criterion.lower);
    const auto number = [digits](double value) { return number_markup(value, digits); };
    if(below && above)
      return number(criterion.lower) + text(" to ") + number(criterion.upper);
    if(below)
      return text("≤ ") + number(criterion.upper);
    return above ? text("≥ ") + number(criterion.lower) : text("none");
  }

  namespace
  {
    Markup verdict_line(const MatrixResult &result)
    {
      const auto held = std::count_if(result.criteria.begin(), result.criteria.end(),
                                      [](const CriterionResult &c) { return c.passed; });
      const auto all = static_cast<long>(result.criteria.size());
      if(all == 0 && !result.stability.empty())
        return {};
      const std::string words
          = all == 0 ? "No acceptance criterion was set"
            : held == all
                ? (all == 1 ? std::string("The acceptance criterion holds")
                            : fmt::format("All {} acceptance criteria hold", all))
                : fmt::format("{} of {} acceptance criteria hold", held, all);
      const std::string kind = all == 0 ? "fair" : (held == all ? "good" : "bad");
      return element("p", {{"class", "verdict " + kind}}, text(words));
    }

    /** The second half of the verdict where the matrix has hard cases. */
    Markup stability_line(const std::vector<StabilityVerdict> &verdicts)
    {
      if(verdicts.empty())
        return {};
      const auto failed = std::count_if(verdicts.begin(), verdicts.end(),
                                        [](const StabilityVerdict &v)
                                        { return v.verdict == "failed"; });
      const std::string words
          = failed == 0
                ? fmt::format(
                    "All {} hard runs held, were caught or refused with a reason",
                    verdicts.size())
                : fmt::format("{} of {} hard runs failed", failed, verdicts.size());
      return element("p", {{"class", failed == 0 ? "verdict good" : "verdict bad"}},
                     text(words));
    }

    Markup findings_line(const std::vector<FindingResult> &findings)
    {
      if(findings.empty())
        return {};
      const auto held = std::ranges::count_if(findings, &FindingResult::holds);
      const auto all = static_cast<long>(findings.size());
      return element("p", {{"class", held == all ? "verdict good" : "verdict bad"}},
                     text(held == all
                              ? fmt::format("All {} findings hold", all)
                              : fmt::format("{} of {} findings hold", held, all)));
    }

    Markup facts(const MatrixResult &result)
    {
      int finished = 0, refused = 0, failed = 0;
      double cpu = 0;
      std::set<std::string> methods;
      for(const RunRecord &run : result.runs)
      {
        methods.insert(run.method);
        finished += run.status == RunStatus::finished;
        refused += run.status == RunStatus::refused;
        failed += run.status == RunStatus::failed;
        if(std::isfinite(cpu_seconds(run)))
          cpu += cpu_seconds(run);
      }
      Markup list;
      const auto add = [&list](const std::string &what, const std::string &value)
      { list += element("div", element("dt", what) + element("dd", value)); };
      add("cases", std::to_string(result.cases.size()));
      add("methods", std::to_string(methods.size()));
      add("runs finished", std::to_string(finished));
      add("refused", std::to_string(refused));
      add("failed", std::to_string(failed));
      add("CPU time of the runs", duration_text(cpu));
      return element("dl", {{"class", "facts"}}, list);
    }

    Markup omissions(const std::vector<std::string> &sentences)
    {
      if(sentences.empty())
        return {};
      std::vector<Markup> items;
      for(const std::string &sentence : sentences)
        items.push_back(text(sentence));
      constexpr std::size_t most_shown = 6;
      if(items.size() <= most_shown)
        return element("h3", "Skipped runs and unjudged criteria") + list("ul", items);
      return element(
          "details",
          element("summary",
                  fmt::format("{} skipped runs and unjudged criteria", items.size()))
              + list("ul", items));
    }
  } // namespace

  std::string remarks_on(const CriterionResult &criterion)
  {
    std::string words = criterion.remark;
    if(!criterion.expected_failure.empty())
      words += (words.empty() ? "" : "; ")
               + ("expected failure: " + criterion.expected_failure);
    return words;
  }

  Markup criteria_table(const std::vector<CriterionResult> &criteria, bool with_case)
  {
    if(criteria.empty())
      return {};
    Markup head = element("th", std::string());
    if(with_case)
      head += element("th", std::string("case"));
    head += element("th", std::string("method")) + element("th", std::string("quantity"));
    for(const char *heading : {"value", "bound"})
      head += element("th", {{"class", "number"}}, text(heading));
    head += element("th", std::string());
    Markup rows;
    for(const CriterionResult &criterion : criteria)
    {
      Markup row = element("td", criterion.passed ? badge("good", "PASS")
                                                  : badge("bad", "FAIL"));
      if(with_case)
        row += element("td", case_link(criterion.case_name));
      row += element("td", criterion.method) + element("td", criterion.quantity)
             + element("td", {{"class", "number"}}, number_markup(criterion.value))
             + element("td", {{"class", "number"}}, bound_of(criterion))
             + element("td", remarks_on(criterion));
      rows += element("tr", row) + Markup("\n");
    }
    return element(
        "div", {{"class", "scroll plain"}},
        element("table", element("thead", element("tr", head)) + element("tbody", rows)));
  }

  Markup verdict_chapter(const ReportContext &context)
  {
    const MatrixResult &result = context.result;
    std::string kicker = "meltfront";
    for(const std::string &part :
        {result.program_version, "matrix " + result.name, result.date})
      if(!part.empty())
        kicker += " · " + part;
    Markup content
        = element("p", {{"class", "kicker"}}, text(kicker))
          + element("h1", result.title.empty() ? "Matrix " + result.name : result.title)
          + verdict_line(result) + text(" ") + stability_line(result.stability)
          + text(" ") + findings_line(result.findings) + glance(context);
    if(!result.description.empty())
      content += element("p", {{"class", "lead"}}, text(result.description));
    content += facts(result);
    std::vector<CriterionResult> failed;
    std::copy_if(result.criteria.begin(), result.criteria.end(),
                 std::back_inserter(failed),
                 [](const CriterionResult &criterion) { return !criterion.passed; });
    if(!failed.empty())
      content
          += element("h3", "Criteria that do not hold") + criteria_table(failed, true);
    content += omissions(result.omissions);
    return element("header", {{"id", "verdict"}}, content);
  }
} // namespace meltfront::verification
