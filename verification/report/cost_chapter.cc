#include <verification/report/case_plots.h>
#include <verification/report/chapters.h>
#include <verification/report/convergence_table.h>
#include <verification/report/cost_at_error.h>
#include <verification/report/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    constexpr double always_wanted[] = {1e-2, 1e-3, 1e-4, 1e-6};
    constexpr double wanted_if_reached = 1e-8;

    /** The errors that columns stand for. */
    std::vector<double> wanted_errors(const ReportContext &context)
    {
      std::vector<double> wanted(std::begin(always_wanted), std::end(always_wanted));
      if(std::any_of(context.runs.begin(), context.runs.end(),
                     [](const CaseRuns &runs) {
                       return cheapest(runs, wanted_if_reached).reach
                              != Reach::not_reached;
                     }))
        wanted.push_back(wanted_if_reached);
      return wanted;
    }

    bool has_relative_error(const CaseRuns &runs)
    {
      return std::any_of(runs.labels.begin(), runs.labels.end(),
                         [&runs](const LabelRuns &label)
                         { return !relative_work_precision(label, runs).error.empty(); });
    }

    Markup cost_cell(const ReportContext &context, const CostAtError &found)
    {
      if(found.reach == Reach::not_reached)
        return element("td", {{"class", "off"}}, text("not reached"));
      const std::string prefix = found.reach == Reach::coarsest ? "≤ " : "";
      return element("td", context.styles.key(found.label) + void_element("br")
                               + element("b", prefix + duration_text(found.cost)));
    }

    Markup cost_table(const ReportContext &context)
    {
      Markup head = element("th", std::string("case"));
      for(const double wanted : wanted_errors(context))
        head += element("th", number_text(wanted, 1, Notation::scientific).markup());
      Markup rows;
      for(const CaseRuns &runs : context.runs)
      {
        if(!has_relative_error(runs))
          continue;
        Markup row = element("td", case_link(runs.record->name));
        for(const double wanted : wanted_errors(context))
          row += cost_cell(context, cheapest(runs, wanted));
        rows += element("tr", row) + Markup("\n");
      }
      return element("div", {{"class", "scroll"}},
                     element("table", element("thead", element("tr", head))
                                          + element("tbody", rows)));
    }

    std::string cost_csv(const ReportContext &context)
    {
      std::string csv = "case,relative_error,method,cpu_seconds,found\n";
      constexpr const char *words[] = {"not reached", "interpolated", "upper bound"};
      for(const CaseRuns &runs : context.runs)
        for(const double wanted : wanted_errors(context))
          if(has_relative_error(runs))
          {
            const CostAtError found = cheapest(runs, wanted);
            const bool reached = found.reach != Reach::not_reached;
            csv += fmt::format("{},{:g},{},{},{}\n", csv_field(runs.record->name), wanted,
                               csv_field(found.label),
                               reached ? fmt::format("{:.6g}", found.cost) : "nan",
                               words[static_cast<int>(found.reach)]);
          }
      return csv;
    }

    /** The same axes for all diagrams. */
    void share_axes(std::vector<Plot> &plots)
    {
      Plot all = plots.front();
      for(const Plot &plot : plots)
      {
        all.curves.insert(all.curves.end(), plot.curves.begin(), plot.curves.end());
        all.failed.insert(all.failed.end(), plot.failed.begin(), plot.failed.end());
      }
      choose_ranges(all);
      for(Plot &plot : plots)
      {
        plot.x = all.x;
        plot.y = all.y;
      }
    }

    Markup small_multiples(const ReportContext &context)
    {
      std::vector<Plot> plots;
      for(const CaseRuns &runs : context.runs)
        if(has_relative_error(runs))
          plots.push_back(small_work_precision(runs, context.styles));
      share_axes(plots);
      Markup figures;
      for(const Plot &plot : plots)
        figures += context.plots.figure("work-precision-" + plot.heading, plot, {});
      return context.styles.legend(context.labels())
             + element("div", {{"class", "multiples"}}, figures);
    }
  } // namespace

  Markup cost_chapter(const ReportContext &context)
  {
    Markup content = element("h2", "What accuracy costs");
    if(std::none_of(context.runs.begin(), context.runs.end(), has_relative_error))
      content += element(
          "p", "No finished run can be compared with an exact solution or a reference.");
    else
    {
      content
          += element(
                 "p",
                 "The cheapest method that reaches an error, and the CPU time "
                 "that it takes. The error is the front's root mean square over the run, "
                 "divided by the exact front at the end; where there is no exact "
                 "solution, the error of the solid's volume at the end, divided by the "
                 "reference's volume; where nothing changes its phase, the "
                 "temperature's root mean square over its largest value. Times are "
                 "interpolated "
                 "between measured resolutions, never extrapolated; ≤ marks a "
                 "method whose coarsest run is already better.")
             + cost_table(context)
             + linked_csv(context, "what-accuracy-costs", cost_csv(context))
             + element("h3", "Work-precision diagrams") + small_multiples(context)
             + element(
                 "p", {{"class", "nothing"}},
                 text("All diagrams share their axes. A cross at the upper edge is a "
                      "run that failed or was refused."));
    }
    return element("section", {{"id", "cost"}}, content);
  }
} // namespace meltfront::verification
