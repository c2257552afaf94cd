#include <verification/report/chapters/chapters.h>
#include <verification/report/tables/cost_at_error.h>
#include <verification/report/tables/equal_cost.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

namespace meltfront::verification
{
  namespace
  {
    /** Names with how often each stands for something, the most frequent first. */
    class Tally
    {
    public:
      void add(const std::string &name)
      {
        const auto known
            = std::ranges::find(counts, name, &std::pair<std::string, int>::first);
        if(known == counts.end())
          counts.emplace_back(name, 1);
        else
          ++known->second;
      }

      /** `sph 5, fem-cut 2`; of a single thing its name only. */
      std::string text(bool counted) const
      {
        std::vector<std::pair<std::string, int>> sorted = counts;
        std::ranges::stable_sort(sorted, std::greater<>(),
                                 &std::pair<std::string, int>::second);
        std::vector<std::string> words;
        for(const auto &[name, count] : sorted)
          words.push_back(counted ? fmt::format("{} {}", name, count) : name);
        return fmt::format("{}", fmt::join(words, ", "));
      }

      bool empty() const
      {
        return counts.empty();
      }

    private:
      std::vector<std::pair<std::string, int>> counts;
    };

    /** A row: wanted error, who is the cheapest in how many cases, the times there. */
    Markup cheapest_row(const std::vector<CaseRuns> &cases, double wanted)
    {
      Tally methods;
      std::vector<double> costs;
      bool bounds = true; // the coarsest runs are better already
      for(const CaseRuns &runs : cases)
        if(const CostAtError found = cheapest(runs, wanted);
           found.reach != Reach::not_reached)
        {
          methods.add(found.label);
          costs.push_back(found.cost);
          bounds = bounds && found.reach == Reach::coarsest;
        }
      Markup cells = element("td", number_markup(wanted, 1));
      if(costs.empty())
        return element("tr", cells
                                 + element("td", {{"class", "off"}}, text("not reached"))
                                 + element("td", std::string()));
      const bool several = cases.size() > 1;
      std::string names = methods.text(several);
      if(several)
        names += fmt::format(" of {}", cases.size());
      const auto [least, most] = std::ranges::minmax(costs);
      std::string times = (bounds ? "≤ " : "") + duration_text(least);
      if(duration_text(most) != duration_text(least))
        times += " to " + duration_text(most);
      return element("tr", cells + element("td", names) + element("td", times));
    }

    Markup cheapest_table(const ReportContext &context)
    {
      std::vector<CaseRuns> cases = context.runs;
      std::erase_if(cases,
                    [](const CaseRuns &runs) { return !has_relative_error(runs); });
      if(cases.empty())
        return {};
      Markup head, rows;
      for(const char *heading : {"relative error", "cheapest", "CPU"})
        head += element("th", std::string(heading));
      for(const double wanted : wanted_errors(cases))
        rows += cheapest_row(cases, wanted) + Markup("\n");
      return element("div", {{"class", "scroll plain"}},
                     element("table", element("thead", element("tr", head))
                                          + element("tbody", rows)));
    }

    /** Of `Left out: NAMES: REASON` those names, and so of all remarks that begin alike.
     */
    Markup names_in_remarks(const std::vector<std::string> &remarks,
                            const std::string &beginning)
    {
      std::vector<std::string> names;
      for(const std::string &remark : remarks)
        if(remark.starts_with(beginning + ": "))
        {
          const std::size_t from = beginning.size() + 2;
          names.push_back(remark.substr(from, remark.find(": ", from) - from));
        }
      if(names.empty())
        return {};
      return element("b", beginning + ": ")
             + text(fmt::format("{}.", fmt::join(names, ", ")));
    }

    Markup criteria_not_held(const std::vector<CriterionResult> &criteria)
    {
      constexpr std::size_t most_named = 3;
      std::vector<std::string> names;
      for(const CriterionResult &criterion : criteria)
        if(!criterion.passed)
          names.push_back(fmt::format("{}, {}: {}", criterion.case_name, criterion.method,
                                      criterion.quantity));
      if(names.empty())
        return {};
      const std::size_t more = names.size() - std::min(names.size(), most_named);
      names.resize(names.size() - more);
      return element("b", "Does not hold: ")
             + text(fmt::format("{}{}.", fmt::join(names, "; "),
                                more > 0 ? fmt::format("; {} more", more) : ""));
    }

    Markup runs_that_ended(const std::vector<RunRecord> &runs, RunStatus status,
                           const std::string &word)
    {
      Tally labels;
      for(const RunRecord &run : runs)
        if(run.status == status)
          labels.add(run.label);
      return labels.empty() ? Markup()
                            : element("b", word + ": ") + text(labels.text(true) + ".");
    }
  } // namespace

  Markup glance(const ReportContext &context)
  {
    const MatrixResult &result = context.result;
    std::vector<Markup> items{
        criteria_not_held(result.criteria),
        runs_that_ended(result.runs, RunStatus::failed, "Runs failed"),
        runs_that_ended(result.runs, RunStatus::refused, "Runs refused"),
        names_in_remarks(result.remarks, "Ended early"),
        names_in_remarks(result.remarks, "Left out")};
    std::erase_if(items, [](const Markup &item) { return item.empty(); });
    Markup table = cheapest_table(context);
    if(table.empty()) // nothing is added to what the other chapters say
      return {};
    if(items.empty())
      items.push_back(text("Nothing failed, nothing was refused."));
    return element("div", {{"class", "glance"}}, table + list("ul", items));
  }
} // namespace meltfront::verification
