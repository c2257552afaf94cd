#include <verification/report/chapters/chapters.h>

#include <fmt/format.h>

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
      return verdict == "refused" ? "fair" : "bad";
    }

    template <typename Member>
    std::vector<std::string> distinct(const std::vector<StabilityVerdict> &verdicts,
                                      Member member)
    {
      std::vector<std::string> list;
      for(const StabilityVerdict &verdict : verdicts)
        if(std::find(list.begin(), list.end(), verdict.*member) == list.end())
          list.push_back(verdict.*member);
      return list;
    }

    std::string resolutions(const std::vector<const StabilityVerdict *> &verdicts)
    {
      std::set<int> distinct_n;
      for(const StabilityVerdict *verdict : verdicts)
        distinct_n.insert(verdict->n);
      std::string list;
      for(const int n : distinct_n)
        list += fmt::format("{}{}", list.empty() ? "" : ", ", n);
      return list;
    }

    /** The verdicts of one case and label: one badge per verdict, with its resolutions.
     */
    Markup verdict_cell(const std::vector<StabilityVerdict> &verdicts,
                        const std::string &case_name, const std::string &label,
                        Footnotes &footnotes)
    {
      std::map<std::string, std::vector<const StabilityVerdict *>> by_verdict;
      std::set<int> all_n;
      for(const StabilityVerdict &verdict : verdicts)
        if(verdict.case_name == case_name && verdict.label == label)
        {
          by_verdict[verdict.verdict].push_back(&verdict);
          all_n.insert(verdict.n);
        }
      if(all_n.empty())
        return element("td", {{"class", "off"}}, text("\u2013"));
      Markup content;
      for(const auto &[verdict, members] : by_verdict)
      {
        std::string words = verdict;
        if(all_n.size() > 1)
          words += " (n = " + resolutions(members) + ")";
        else if(members.size() > 1)
          words += fmt::format(" ({} runs)", members.size());
        content += badge(kind_of(verdict), words);
        std::vector<int> numbers;
        for(const StabilityVerdict *member : members)
          if(!member->reason.empty())
            if(const int number = footnotes.number(member->reason);
               std::find(numbers.begin(), numbers.end(), number) == numbers.end())
              numbers.push_back(number);
        std::string marks;
        for(const int number : numbers)
          marks += fmt::format("{}{}", marks.empty() ? "" : ",", number);
        if(!marks.empty())
          content += element("sup", " " + marks);
        content += text(" ");
      }
      return element("td", content);
    }

    Markup summary(const std::vector<StabilityVerdict> &verdicts)
    {
      int held = 0, refused = 0, failed = 0;
      for(const StabilityVerdict &verdict : verdicts)
      {
        held += verdict.verdict == "held";
        refused += verdict.verdict == "refused";
        failed += verdict.verdict != "held" && verdict.verdict != "refused";
      }
      return element("p", text(fmt::format("Runs: {}; ", verdicts.size()))
                              + element("b", fmt::format("{} held", held))
                              + text(fmt::format(
                                  ", {} refused with a reason, {} failed. "
                                  "A run that held is finite, within the "
                                  "maximum principle, closes its heat budget "
                                  "and moves its front only as physics says. A dash: the "
                                  "matrix has no such run.",
                                  refused, failed)));
    }
  } // namespace

  Markup stability_chapter(const ReportContext &context)
  {
    const auto &verdicts = context.result.stability;
    if(verdicts.empty())
      return {};
    const auto labels = distinct(verdicts, &StabilityVerdict::label);
    Footnotes footnotes;
    Markup head = element("th", std::string("case"));
    for(const std::string &label : labels)
      head += element("th", context.styles.key(label));
    Markup rows;
    for(const std::string &case_name : distinct(verdicts, &StabilityVerdict::case_name))
    {
      Markup row = element("td", case_link(case_name));
      for(const std::string &label : labels)
        row += verdict_cell(verdicts, case_name, label, footnotes);
      rows += element("tr", row) + Markup("\n");
    }
    const Markup reasons = footnotes.list_of_reasons();
    return element("h2", "What stays stable") + summary(verdicts)
           + element("div", {{"class", "scroll"}},
                     element("table", element("thead", element("tr", head))
                                          + element("tbody", rows)))
           + (reasons.empty() ? Markup() : element("h3", "Reasons") + reasons);
  }
} // namespace meltfront::verification
