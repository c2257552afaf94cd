#include <verification/report/chapters/chapters.h>
#include <verification/report/plots/case_plots.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/cost_at_error.h>
#include <verification/report/tables/table.h>

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
        Markup row = element("td", case_link(runs.record->name()));
        for(const double wanted : wanted_errors(context))
          row += cost_cell(context, cheapest(runs, wanted));
        rows += element("tr", row) + Markup("\n");
      }
      return element("div", {{"class", "scroll"}},
                     element("table", element("thead", element("tr", head))
                                          + element("tbody", rows)));
    }

    /** How the times of runs came about and how far they can be trusted. */
    std::string timing_sentence(const MatrixResult &result)
    {
      long careful = 0, repeated = 0, agreeing = 0, loaded = 0, timed = 0;
      for(const RunRecord &run : result.runs)
      {
        if(run.status != RunStatus::finished || run.times.cpu.empty())
          continue;
        ++timed;
        careful += run.times.careful;
        repeated += run.times.cpu.size() > 2;
        agreeing += agree_within(run.times, 0.05);
        loaded += disturbed(run.times);
      }
      if(timed == 0)
        return {};
      return fmt::format(
          " Of {} runs {} were timed carefully (least of five to fifteen repeats in turn "
          "with the others), the rest quickly (least of up to five at once if shorter "
          "than "
          "0.5 s, else a single run). The three least times of a run agree within 5 % in "
          "{} of the {} runs that were repeated; {} runs were disturbed, their fastest "
          "repeat on a shared core.",
          timed, careful, agreeing, repeated, loaded);
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
            csv += fmt::format("{},{:g},{},{},{}\n", csv_field(runs.record->name()),
                               wanted, csv_field(found.label),
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

    /** Steps and time of runs that no error belongs to: particle solids. */
    Markup step_costs(const ReportContext &context)
    {
      Table table;
      table.group_heading = "case";
      table.columns = {{"particles", "", true},   {"steps", "", true},
                       {"runs", "", true},        {"CPU of the first", "s", true},
                       {"CPU of all", "s", true}, {"per particle and step", "ns", true}};
      for(const CaseRuns &runs : context.runs)
      {
        if(!moves_particles(*runs.record))
          continue;
        RowGroup group;
        for(const LabelRuns &label : runs.labels)
          for(const Level &level : label.levels)
          {
            if(!level.finished)
              continue;
            const cases::Cost &cost = level.finished->cost;
            group.label = fmt::format("{}, {}", runs.record->name(), label.label);
            group.rows.push_back(
                {{NumberText{grouped(cost.steps > 0 ? cost.work / cost.steps : 0), {}}},
                 {NumberText{grouped(cost.steps), {}}},
                 {NumberText{grouped(level.finished_count), {}}},
                 {prose_number(cpu_seconds(*level.finished), 3)},
                 {prose_number(level.value("cpu_seconds") * level.finished_count, 3)},
                 {prose_number(1e9 * cost.stepping_cpu / static_cast<double>(cost.work),
                               3)}});
            table.groups.push_back(group);
            group.rows.clear();
          }
      }
      return table.empty()
                 ? Markup()
                 : element("p",
                           "What the runs of particle solids took: no exact solution "
                           "tells an error that a cost could be held against.")
                       + table_markup(table);
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
    const Markup solids = step_costs(context);
    const bool compared
        = std::any_of(context.runs.begin(), context.runs.end(), has_relative_error);
    // What it costs there, the answers tell.
    if(!compared && solids.empty() && context.result.cases.size() == 1)
      return {};
    Markup content = element("h2", compared || solids.empty() ? "What accuracy costs"
                                                              : "What the runs cost");
    if(!compared)
    {
      if(solids.empty())
        content += element(
            "p",
            "No finished run can be compared with an exact solution or a reference.");
      content += solids;
    }
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
                 "temperature's root mean square over its largest value; of a front "
                 "that is carried along, the part of the region that is wrong at the "
                 "end. Times are "
                 "interpolated "
                 "between measured resolutions, never extrapolated; ≤ marks a "
                 "method whose coarsest run is already better.")
             + cost_table(context)
             + linked_csv(context, "what-accuracy-costs", cost_csv(context))
             + element("h3", "Work-precision diagrams") + small_multiples(context)
             + element(
                 "p", {{"class", "nothing"}},
                 text("All diagrams share their axes. A cross at the upper edge is a "
                      "run that failed or was refused."
                      + timing_sentence(context.result)))
             + solids;
    }
    return content;
  }
} // namespace meltfront::verification
