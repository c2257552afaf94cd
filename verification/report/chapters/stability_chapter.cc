#include <verification/judge/stability.h>
#include <verification/record/label.h>
#include <verification/report/chapters/chapters.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    /** Reasons, numbered in the order in which they first appear. */
    class Footnotes
    {
    public:
      int number(const std::string &reason)
      {
        const auto found = std::find(reasons.begin(), reasons.end(), reason);
        if(found != reasons.end())
          return static_cast<int>(found - reasons.begin()) + 1;
        reasons.push_back(reason);
        return static_cast<int>(reasons.size());
      }

      Markup list_of_reasons() const
      {
        std::vector<Markup> items;
        for(const std::string &reason : reasons)
          items.push_back(text(reason));
        return list("ol", items);
      }

    private:
      std::vector<std::string> reasons;
    };

    std::string kind_of(const std::string &verdict)
    {
      if(verdict == "held")
        return "good";
      return verdict == "failed" ? "bad" : "fair";
    }

    /** Distinct values, in the order in which they first appear. */
    template <typename Value>
    std::vector<std::string> distinct(const std::vector<StabilityVerdict> &verdicts,
                                      const Value &value)
    {
      std::vector<std::string> list;
      for(const StabilityVerdict &verdict : verdicts)
        if(const std::string found = value(verdict);
           std::ranges::find(list, found) == list.end())
          list.push_back(found);
      return list;
    }

    using Members = std::vector<const StabilityVerdict *>;

    std::string resolutions(const Members &members)
    {
      std::set<int> distinct_n;
      for(const StabilityVerdict *member : members)
        distinct_n.insert(member->n);
      return fmt::format("{}", fmt::join(distinct_n, ", "));
    }

    /** What a run shows: its error if it held, else what decided; null if it has
     * neither. */
    const StabilityMeasure *figure_of(const StabilityVerdict &verdict)
    {
      if(verdict.verdict != "held")
        return verdict.measures.empty() ? nullptr : &verdict.measures.front();
      const auto error = std::ranges::find_if(verdict.measures, is_error);
      return error == verdict.measures.end() ? nullptr : &*error;
    }

    /** Of the run that is nearest to the bound, or farthest beyond it. */
    std::string worst_figure(const Members &members)
    {
      const StabilityMeasure *worst = nullptr;
      for(const StabilityVerdict *member : members)
        if(const StabilityMeasure *figure = figure_of(*member);
           figure && (!worst || figure->share() > worst->share()))
          worst = figure;
      return worst ? fmt::format("{} {:.2g} of {:.2g}", worst->name, worst->value,
                                 worst->bound)
                   : "";
    }

    Markup reason_marks(const Members &members, Footnotes &footnotes)
    {
      std::set<int> numbers;
      for(const StabilityVerdict *member : members)
        if(!member->reason.empty())
          numbers.insert(footnotes.number(member->reason));
      return numbers.empty()
                 ? Markup()
                 : element("sup", fmt::format(" {}", fmt::join(numbers, ",")));
    }

    /** The runs of one label: one badge per verdict, with its resolutions, a figure
     * and the reasons. */
    Markup label_line(const std::string &label, const Members &runs, Footnotes &footnotes)
    {
      std::map<std::string, Members> by_verdict;
      for(const StabilityVerdict *run : runs)
        by_verdict[run->verdict].push_back(run);
      const std::size_t bracket = label.find('[');
      Markup content;
      if(bracket != std::string::npos)
        content += text(label.substr(bracket + 1, label.size() - bracket - 2) + " ");
      for(const auto &[verdict, members] : by_verdict)
      {
        const std::string where
            = by_verdict.size() > 1 ? " (n = " + resolutions(members) + ")" : "";
        content += badge(kind_of(verdict), verdict + where);
        content += text(" " + worst_figure(members));
        content += reason_marks(members, footnotes) + text(" ");
      }
      return element("div", content);
    }

    Markup method_cell(const std::vector<StabilityVerdict> &verdicts,
                       const std::string &case_name, const std::string &method,
                       Footnotes &footnotes)
    {
      std::vector<std::string> labels;
      std::map<std::string, Members> runs;
      for(const StabilityVerdict &verdict : verdicts)
        if(verdict.case_name == case_name && method_of(verdict.label) == method)
        {
          if(runs[verdict.label].empty())
            labels.push_back(verdict.label);
          runs[verdict.label].push_back(&verdict);
        }
      if(labels.empty())
        return element("td", {{"class", "off"}}, text("\u2013"));
      Markup content;
      for(const std::string &label : labels)
        content += label_line(label, runs[label], footnotes);
      return element("td", content);
    }

    /** What is asked, and the run that came nearest to each bound and held. */
    Markup nearest_to_bounds(const std::vector<StabilityVerdict> &verdicts)
    {
      struct Nearest
      {
        const StabilityVerdict *verdict;
        const StabilityMeasure *measure;
        int runs;
      };
      std::map<std::string, Nearest> nearest;
      for(const StabilityVerdict &verdict : verdicts)
        if(verdict.verdict == "held")
          for(const StabilityMeasure &measure : verdict.measures)
          {
            const auto [at, is_new]
                = nearest.try_emplace(measure.name, Nearest{&verdict, &measure, 0});
            Nearest &known = at->second;
            ++known.runs;
            if(measure.share() > known.measure->share())
              known = {&verdict, &measure, known.runs};
          }
      Markup rows;
      for(const auto &[name, found] : nearest)
        rows += element(
            "tr",
            element("td", name) + element("td", std::to_string(found.runs))
                + element("td", {{"class", "number"}},
                          number_markup(found.measure->value))
                + element("td", {{"class", "number"}},
                          number_markup(found.measure->bound))
                + element("td", fmt::format("{}, {}, n = {}", found.verdict->case_name,
                                            found.verdict->label, found.verdict->n)));
      Markup head;
      for(const char *heading :
          {"measure", "runs held", "nearest to its bound", "bound", "of the run"})
        head += element("th", std::string(heading));
      return element("h3", "What was measured")
             + element("div", {{"class", "scroll plain"}},
                       element("table", element("thead", element("tr", head))
                                            + element("tbody", rows)));
    }

    Markup summary(const std::vector<StabilityVerdict> &verdicts)
    {
      std::map<std::string, int> count;
      for(const StabilityVerdict &verdict : verdicts)
        ++count[verdict.verdict];
      return element(
          "p",
          text(fmt::format("Runs: {}; ", verdicts.size()))
              + element("b", fmt::format("{} held", count["held"]))
              + text(fmt::format(
                  ", {} caught, {} refused with a reason, {} failed. A run that held is "
                  "finite, within the maximum principle, closes its heat budget, moves "
                  "its front only as physics says and ends near the exact solution, or, "
                  "where there is none, near what the other methods agree on. A run that "
                  "was made unstable on purpose has to be caught: stopped by a check, "
                  "not "
                  "returned. Beside each run that held stands its error over the "
                  "domain's side and "
                  "the bound, of the n that is nearest to it. A dash: the matrix has no "
                  "such run.",
                  count["caught"], count["refused"], count["failed"])));
    }
  } // namespace

  Markup stability_chapter(const ReportContext &context)
  {
    const auto &verdicts = context.result.stability;
    if(verdicts.empty())
      return {};
    const auto methods = distinct(verdicts, [](const StabilityVerdict &verdict)
                                  { return method_of(verdict.label); });
    Footnotes footnotes;
    Markup head = element("th", std::string("case"));
    for(const std::string &method : methods)
      head += element("th", context.styles.key(method));
    Markup rows;
    for(const std::string &case_name : distinct(
            verdicts, [](const StabilityVerdict &verdict) { return verdict.case_name; }))
    {
      Markup row = element("td", case_link(case_name));
      for(const std::string &method : methods)
        row += method_cell(verdicts, case_name, method, footnotes);
      rows += element("tr", row) + Markup("\n");
    }
    const Markup reasons = footnotes.list_of_reasons();
    return element("h2", "What stays stable") + summary(verdicts)
           + element("div", {{"class", "scroll"}},
                     element("table", element("thead", element("tr", head))
                                          + element("tbody", rows)))
           + (reasons.empty() ? Markup() : element("h3", "Reasons") + reasons)
           + nearest_to_bounds(verdicts);
  }
} // namespace meltfront::verification
