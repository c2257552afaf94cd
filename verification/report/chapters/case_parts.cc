#include <verification/report/chapters/case_parts.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <map>
#include <tuple>

namespace meltfront::verification
{
  Markup pair(const Markup &left, const Markup &right, const std::string &kind)
  {
    return element("div", {{"class", kind}}, left + right);
  }

  Markup folded(const std::string &summary, const Markup &content)
  {
    return content.empty() ? Markup()
                           : element("details", element("summary", summary) + content);
  }

  Markup chapter_head(const StoredCase &record)
  {
    std::string tags = record.name();
    for(const std::string &tag : record.tags)
      tags += " · " + tag;
    Markup content = element("p", {{"class", "tags"}}, text(tags))
                     + element("h2", record.title.empty() ? record.name() : record.title);
    if(!record.description.empty())
      content += element("p", record.description);
    return content;
  }

  Markup parameters(const CaseRuns &runs)
  {
    Table table;
    table.columns = {{"parameter", "", false}, {"value", "", false}, {"unit", "", false}};
    for(const LabelRuns &label : runs.labels)
      if(const RunRecord *run = label.finest())
      {
        RowGroup &group = table.groups.emplace_back();
        group.label = fmt::format("{}, n = {}", label.label, run->n);
        const auto add = [&group](const std::string &name, const std::string &value,
                                  const std::string &unit) {
          group.rows.push_back({{name}, {value}, {unit}});
        };
        add("dimension", std::to_string(run->description.dimension), "");
        if(run->description.time_step > 0)
          add("time step", plain_number(run->description.time_step, 4), "s");
        if(run->description.smoothing_length > 0)
          add("smoothing length", plain_number(run->description.smoothing_length, 4),
              "m");
        for(const cases::Parameter &parameter : run->description.parameters)
          add(parameter.name, parameter.value, parameter.unit);
        for(const auto &[key, value] : run->options)
          add("option " + key, value, "");
        for(const RunEvent &event : run->events)
          add(fmt::format("event at t = {}", plain_number(event.time, 6)), event.what,
              "");
      }
    return table.empty() ? Markup() : table_markup(table);
  }

  Markup printed(const ReportContext &context, const CaseRuns &runs)
  {
    const Table table = printed_table(runs);
    if(table.empty())
      return {};
    return element("h3", "Printed in papers, beside ours")
           + element(
               "p", {{"class", "nothing"}},
               text("Orders are in n, the number along a side, fitted to the printed "
                    "and to the measured numbers in the same way."))
           + table_markup(table)
           + linked_csv(context, runs.record->name() + "-printed", printed_csv(runs));
  }

  Markup criteria(const ReportContext &context, const StoredCase &record)
  {
    std::vector<CriterionResult> own;
    for(const CriterionResult &criterion : context.result.criteria)
      if(criterion.case_name == record.name())
        own.push_back(criterion);
    return own.empty()
               ? Markup()
               : element("h3", "Acceptance criteria") + criteria_table(own, false);
  }

  namespace
  {
    /** The runs that ended otherwise than they should, those of one reason together. */
    std::vector<Markup> unfinished(const LabelRuns &label)
    {
      using Reason = std::tuple<int, RunStatus, std::string>;
      std::map<Reason, int> reasons;
      for(const Level &level : label.levels)
        for(const RunRecord *run : level.runs)
          if(run->status != RunStatus::finished)
            ++reasons[{run->n, run->status, run->message}];
      std::vector<Markup> items;
      for(const auto &[reason, count] : reasons)
      {
        const auto &[n, status, message] = reason;
        items.push_back(
            text(fmt::format("{}, n = {}{}: ", label.label, n,
                             count == 1 ? "" : fmt::format(", {} runs", count)))
            + (status == RunStatus::refused ? badge("fair", "refused")
                                            : badge("bad", "failed"))
            + text(" " + (message.empty() ? "no reason was given" : message)));
      }
      return items;
    }
  } // namespace

  Markup limits(const CaseRuns &runs)
  {
    std::vector<Markup> items;
    for(const std::string &limit : runs.record->limits)
      items.push_back(text(limit));
    for(const LabelRuns &label : runs.labels)
      for(const Markup &item : unfinished(label))
        items.push_back(item);
    return element("h3", "Limits and omissions")
           + (items.empty() ? element("p", "None are known; every run finished.")
                            : list("ul", items));
  }

  Markup effects_and_parameters(const ReportContext &context, const CaseRuns &runs)
  {
    Markup content;
    if(const Markup effects = effects_of_case(context, runs); !effects.empty())
      content += folded("Effects: on or off, because, share of time, memory", effects);
    return content + folded("Schemes and their parameters", parameters(runs));
  }

  Markup chapter_of(const StoredCase &record, const Markup &content)
  {
    return element("section", {{"id", case_anchor(record.name())}}, content)
           + Markup("\n");
  }
} // namespace meltfront::verification
