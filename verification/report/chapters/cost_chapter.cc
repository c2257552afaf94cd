#include <verification/report/chapters/case_parts.h>
#include <verification/report/plots/case_plots.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/cost_at_error.h>
#include <verification/report/tables/equal_cost.h>
#include <verification/report/tables/growth.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    Markup cost_cell(const ReportContext &context, const CostAtError &found)
    {
      if(found.reach == Reach::not_reached)
        return element("td", {{"class", "off"}}, text("not reached"));
      const std::string prefix = found.reach == Reach::coarsest ? "≤ " : "";
      return element("td", context.styles.key(found.label) + void_element("br")
                               + element("b", prefix + duration_text(found.cost)));
    }

    Markup cost_table(const ReportContext &context, const std::vector<double> &errors)
    {
      Markup head = element("th", std::string("case"));
      for(const double wanted : errors)
        head += element("th", number_text(wanted, 1, Notation::scientific).markup());
      Markup rows;
      for(const CaseRuns &runs : context.runs)
      {
        if(!has_relative_error(runs))
          continue;
        Markup row = element("td", case_link(runs.record->name()));
        for(const double wanted : errors)
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

    std::string cost_csv(const ReportContext &context, const std::vector<double> &errors)
    {
      std::string csv = "case,relative_error,method,cpu_seconds,found\n";
      constexpr const char *words[] = {"not reached", "interpolated", "upper bound"};
      for(const CaseRuns &runs : context.runs)
        for(const double wanted : errors)
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

    /** One diagram for each case and each dimension that its methods run in. */
    Markup small_multiples(const ReportContext &context, const std::string &cost)
    {
      std::vector<Plot> plots;
      for(const CaseRuns &runs : context.runs)
        if(has_relative_error(runs))
          for(const int dimension : dimensions_of(runs))
            plots.push_back(small_work_precision(runs, context.styles, dimension, cost));
      share_axes(plots);
      Markup figures;
      for(const Plot &plot : plots)
        figures += context.plots.figure(
            fmt::format("work-precision-{}-{}", cost, plot.heading), plot, {});
      return element("div", {{"class", "multiples"}}, figures);
    }

    Markup diagrams(const ReportContext &context)
    {
      const Markup work
          = element("p", {{"class", "nothing"}},
                    text("Work is the number of interactions or matrix entries that a "
                         "run touched, without set-up: the same on every machine."))
            + small_multiples(context, "work");
      return element("h3", "Work-precision diagrams")
             + element("p", {{"class", "nothing"}},
                       text("One diagram for each dimension that methods run in: in the "
                            "plane the same answer takes more work than along a line. "
                            "All share their axes. A cross at the upper edge is a "
                            "run that failed or was refused."
                            + timing_sentence(context.result)))
             + context.styles.legend(context.labels())
             + small_multiples(context, "cpu_seconds")
             + (context.runs.size() == 1 ? work : folded("The same against work", work));
    }

    /** What each method takes for the same errors and reaches in the same time; folded
     * where there are several cases. */
    Markup equal_costs(const ReportContext &context)
    {
      const auto key
          = [&context](const std::string &label) { return context.styles.key(label); };
      const std::vector<double> errors = wanted_errors(context.runs);
      Markup content;
      for(const CaseRuns &runs : context.runs)
      {
        if(!has_relative_error(runs))
          continue;
        const Markup tables = element("h4", "CPU seconds at equal error")
                              + table_markup(cost_at_equal_error(runs, errors), key)
                              + element("h4", "Relative error at equal cost")
                              + table_markup(error_at_equal_cost(runs), key);
        content
            += context.runs.size() == 1 ? tables : folded(runs.record->name(), tables);
      }
      return element("h3", "Cost at equal error, error at equal cost") + content;
    }

    Markup growth(const ReportContext &context)
    {
      const Table table = growth_table(context.runs);
      if(table.empty())
        return {};
      return element("h3", "How cost grows with the number of unknowns")
             + element(
                 "p",
                 "Exponents of the number of unknowns N over the finest four levels "
                 "(coarser ones are held by a least number of steps), with the half "
                 "width of the 95 % interval by Student's t. In d dimensions a step "
                 "whose "
                 "effort is proportional to N makes t ~ N^(1 + k/d) where the steps are "
                 "~ h^-k: k = 2 for explicit conduction, 1 for steps in proportion to "
                 "the "
                 "spacing, 0 for a fixed number of steps; k is that of the steps that "
                 "each method took between its two finest levels. Work beyond that is "
                 "iterations of a solver; CPU time "
                 "below it, overheads of the coarse levels.")
             + table_markup(table);
    }
  } // namespace

  Markup cost_chapter(const ReportContext &context)
  {
    const bool one_case = context.runs.size() == 1;
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
      const std::vector<double> errors = wanted_errors(context.runs);
      content
          += element(
                 "p",
                 "The cheapest method that reaches an error, and the CPU time "
                 "that it takes. The error is the front's root mean square over the run, "
                 "divided by the exact front at the end, of a curved one by the radius "
                 "of "
                 "a disk or ball of its volume (of a run with too few times for a mean "
                 "the largest, which bounds it); where there is no exact "
                 "solution, the error of the solid's volume at the end, divided by the "
                 "reference's volume; where nothing changes its phase, the "
                 "temperature's root mean square over its largest value; of a front "
                 "that is carried along, the part of the region that is wrong at the "
                 "end; of a scene of which neither is known, the front's distance from "
                 "that of the method which the consensus trusts most, and its error bar, "
                 "divided by the front at the end. Times are those of set-up and steps, "
                 "interpolated "
                 "between measured resolutions, never extrapolated; ≤ marks a "
                 "method whose coarsest run is already better.")
             + (one_case ? Markup() : cost_table(context, errors))
             + linked_csv(context, "what-accuracy-costs", cost_csv(context, errors))
             + equal_costs(context) + diagrams(context) + growth(context) + solids;
    }
    return content;
  }
} // namespace meltfront::verification
