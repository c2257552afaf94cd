#include <verification/report/chapters/chapters.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    std::string order_text(const ReferenceTrust &trust)
    {
      if(!std::isfinite(trust.convergence.order))
        return "none";
      return fmt::format("{}^{:.2f}", trust.symbol, trust.convergence.order);
    }

    const char *course_of(const ReferenceTrust &trust)
    {
      if(std::isnan(trust.convergence.uncertainty))
        return "fewer than three runs";
      if(trust.convergence.uncertainty == 0)
        return "equal";
      return trust.convergence.monotone ? "monotone" : "not monotone";
    }

    std::vector<const ReferenceTrust *> trusts_of(const ReportContext &context,
                                                  const std::string &case_name)
    {
      std::vector<const ReferenceTrust *> list;
      for(const ReferenceTrust &trust : context.result.references)
        if(trust.case_name == case_name)
          list.push_back(&trust);
      return list;
    }

    Table trust_table(const std::vector<const ReferenceTrust *> &trusts)
    {
      constexpr int digits = 10;
      Table table;
      table.columns.push_back({"quantity", "", false});
      const std::vector<int> &levels = trusts.front()->n;
      for(auto n = levels.rbegin(); n != levels.rend(); ++n)
        table.columns.push_back({fmt::format("n = {}", *n), "", true});
      table.columns.push_back({"observed order", "", false});
      table.columns.push_back({"Richardson's limit", "", true});
      table.columns.push_back({"error bar", "", true});
      table.columns.push_back({"course", "", false});
      RowGroup &group = table.groups.emplace_back();
      for(const ReferenceTrust *trust : trusts)
      {
        auto &row = group.rows.emplace_back();
        row.push_back({trust->quantity});
        for(auto value = trust->values.rbegin(); value != trust->values.rend(); ++value)
          row.push_back({number_text(*value, digits)});
        row.push_back({order_text(*trust)});
        row.push_back({number_text(trust->convergence.extrapolated, digits)});
        row.push_back({number_text(trust->bar, 2, Notation::scientific)});
        row.push_back({std::string(course_of(*trust))});
      }
      return table;
    }

    std::string trust_csv(const std::vector<const ReferenceTrust *> &trusts)
    {
      std::string csv = "quantity,n,abscissa,value,order,limit,bar,monotone\n";
      for(const ReferenceTrust *trust : trusts)
        for(std::size_t i = 0; i < trust->values.size(); ++i)
        {
          csv += fmt::format("{},{}", trust->quantity, trust->n[i]);
          for(const double value :
              {trust->abscissa[i], trust->values[i], trust->convergence.order,
               trust->convergence.extrapolated, trust->bar})
            csv += std::isnan(value) ? ",nan" : fmt::format(",{:.16g}", value);
          csv += trust->convergence.monotone ? ",1\n" : ",0\n";
        }
      return csv;
    }
  } // namespace

  Markup reference_of_case(const ReportContext &context, const CaseRuns &runs)
  {
    const StoredCase &record = *runs.record;
    Markup content = element(
        "p",
        fmt::format("There is no exact solution: runs are compared with {} at n = {}.",
                    record.reference->label, record.reference->n));
    const auto trusts = trusts_of(context, record.name());
    if(trusts.empty())
      return content
             + element("p",
                       "It did not run or did not finish: nothing was compared with it.");
    content += element("h4", "How far the reference can be trusted")
               + table_markup(trust_table(trusts))
               + linked_csv(context, record.name() + "-reference", trust_csv(trusts))
               + element(
                   "p", {{"class", "nothing"}},
                   text("Error bar: as of any other run, from its label's finest three. "
                        "Errors below it are not significant."));
    return content;
  }
} // namespace meltfront::verification
