#include <verification/report/case_plots.h>
#include <verification/report/chapters.h>
#include <verification/report/convergence_table.h>
#include <verification/report/equations.h>
#include <verification/report/scene_picture.h>
#include <verification/report/table.h>
#include <verification/report/tracked_front.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    Markup pair(const Markup &left, const Markup &right, const std::string &kind = "pair")
    {
      return element("div", {{"class", kind}}, left + right);
    }

    Markup folded(const std::string &summary, const Markup &content)
    {
      return content.empty() ? Markup()
                             : element("details", element("summary", summary) + content);
    }

    Markup picture(const ReportContext &context, const CaseRuns &runs)
    {
      const CaseRecord &record = *runs.record;
      const RunRecord *run = run_to_picture(runs);
      const double front = front_at_end(runs);
      const bool exact = !record.exact.empty() && std::isfinite(record.front_exact_end);
      std::string caption = record.steady ? "The scene."
                                          : fmt::format("The scene at t = {}{}.",
                                                        plain_number(record.end_time, 6),
                                                        unit_of(record, " s"));
      if(std::isfinite(front))
        caption += fmt::format(" The line is the {} front, at {}{}.",
                               exact ? "exact" : "computed", plain_number(front, 4),
                               unit_of(record, " m"));
      if(run && !record.changes_phase)
        caption += fmt::format(" Sites of {} at n = {}.", run->label, run->n);
      else if(run)
        caption
            += fmt::format(" Sites of {} at n = {}: filled where at least half is solid, "
                           "open where liquid.",
                           run->label, run->n);
      else if(record.changes_phase)
        caption += " Blue: solid; orange: liquid.";
      if(!record.source_positions.empty())
        caption += " Star: source.";
      if(record.measurement.picture_mark == 0)
        caption += restated(record, "particles");
      SceneContent content{run ? run : runs.finest(), front, {}};
      if(const RunRecord *tracked = tracked_run(runs))
      {
        content.tracked = {tracked->frames.back()};
        caption += fmt::format(" Black dots: the front that {} tracked at n = {}.",
                               tracked->label, tracked->n);
      }
      return context.plots.figure(record.name + "-scene",
                                  scene_picture_script(record, content),
                                  "The scene of " + record.name, text(caption));
    }

    /** Tracked fronts at the marks and at the end in one picture. */
    Markup front_frames(const ReportContext &context, const CaseRuns &runs)
    {
      const RunRecord *run = tracked_run(runs);
      if(!run || run->frames.size() < 2)
        return {};
      const CaseRecord &record = *runs.record;
      std::string times;
      for(const FrontFrame &frame : run->frames)
        times += (times.empty() ? "" : ", ") + plain_number(frame.time, 4);
      SceneContent content;
      content.tracked = run->frames;
      return context.plots.figure(
          record.name + "-fronts", scene_picture_script(record, content),
          "Fronts over time, " + record.name,
          text(fmt::format("The front that {} tracked at n = {}, at t = {}{}; black: the "
                           "last.",
                           run->label, run->n, times, unit_of(record, " s"))));
    }

    Markup exact_solution(const CaseRecord &record)
    {
      std::string sentence = record.exact + ".";
      sentence[0]
          = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
      Markup content = element("p", sentence);
      const double floor = record.measurement.front_floor;
      if(std::isfinite(record.front_exact_end))
        content += element("p", text("Its front at the end: ")
                                    + number_markup(record.front_exact_end, 8)
                                    + text(unit_of(record, " m") + "."));
      if(floor > 0)
        content
            += element("p", text("In this domain it holds only approximately: no front "
                                 "error below the floor of ")
                                + number_markup(floor, 2)
                                + text(unit_of(record, " m") + " means anything."));
      else if(record.changes_phase)
        content += element("p", "It is exact in this domain: the table has no floor.");
      return content;
    }

    /** The exact solution, or what stands in its place. */
    Markup yardstick(const ReportContext &context, const CaseRuns &runs)
    {
      const CaseRecord &record = *runs.record;
      if(!record.exact.empty())
        return element("h3", "Exact solution") + exact_solution(record);
      if(record.reference)
        return element("h3", "Reference") + reference_of_case(context, runs);
      return element("h3", "Exact solution")
             + element("p",
                       "There is no exact solution: errors against one cannot be given.");
    }

    Markup convergence(const ReportContext &context, const CaseRuns &runs)
    {
      const CaseRecord &record = *runs.record;
      const Table table = convergence_table(runs);
      const auto key
          = [&context](const std::string &label) { return context.styles.key(label); };
      if(table.empty())
        return element("p", "No run of this case is in the matrix.");
      const Table rates = pairwise_table(runs), orders = orders_table(runs);
      const bool several = orders.groups.size() > 1;
      return element(
                 "p", {{"class", "nothing"}},
                 text(
                     "Orders are fitted by least squares over at least four levels, with "
                     "their standard error: in h, or in dt where only the time step was "
                     "refined. Levels whose error is at round-off (10⁻¹³ of the domain's "
                     "side, 10⁻¹³ where relative) are left out of the fit. "
                     + std::string(record.changes_phase
                                       ? "Errors of the front are root mean squares over "
                                         "the run; bold"
                                       : "Bold")
                     + " is the least of a column."))
             + (several ? table_markup(orders, key) : Markup()) + table_markup(table, key)
             + linked_csv(context, record.name, convergence_csv(runs))
             + (rates.empty() ? Markup()
                              : folded("Rates between neighbouring resolutions",
                                       table_markup(rates, key)));
    }

    Markup error_plots(const ReportContext &context, const CaseRuns &runs)
    {
      const std::string &name = runs.record->name;
      const Plot cost = error_against_cost(runs, context.styles);
      const std::string note
          = cost.failed.empty() ? "" : " A cross marks a run that failed or was refused.";
      std::vector<Markup> figures;
      if(const Plot plot = error_against_spacing(runs, context.styles);
         !plot.curves.empty())
        figures.push_back(context.plots.figure(
            name + "-error-spacing", plot,
            text("Error against spacing, with fitted orders; grey: reference slopes."
                 + note)));
      if(const Plot plot = error_against_time_step(runs, context.styles);
         !plot.curves.empty())
        figures.push_back(context.plots.figure(
            name + "-error-time-step", plot,
            text("Error against time step at one spacing, with fitted orders; grey: "
                 "reference slopes."
                 + note)));
      figures.push_back(context.plots.figure(
          name + "-error-cost", cost,
          text("Error against CPU time: left and low is better; grey: reference slopes."
               + note)));
      Markup content;
      for(std::size_t i = 0; i < figures.size(); i += 2)
        content += pair(figures[i], i + 1 < figures.size() ? figures[i + 1] : Markup());
      return content;
    }

    Markup front_plots(const ReportContext &context, const CaseRuns &runs)
    {
      return pair(context.plots.figure(
                      runs.record->name + "-front",
                      front_against_time(runs, context.styles),
                      text("Front against time, each method's finest run.")),
                  context.plots.figure(
                      runs.record->name + "-front-error",
                      runs.record->exact.empty()
                          ? solid_against_time(runs, context.styles)
                          : front_error_against_time(runs, context.styles),
                      text(runs.record->exact.empty()
                               ? "Volume that is solid against time."
                               : "Its error against time.")))
             + front_frames(context, runs);
    }

    /** Front of every resolution of one method: of the first that was published, else of
     * the first that has three. */
    Markup front_of_all_resolutions(const ReportContext &context, const CaseRuns &runs)
    {
      const LabelRuns *chosen = nullptr;
      for(const LabelRuns &label : runs.labels)
        if(label.levels.size() >= 3 && label.refinement.symbol() == "h"
           && (!chosen
               || (label.label.find("-2005") != std::string::npos
                   && chosen->label.find("-2005") == std::string::npos)))
          chosen = &label;
      if(!chosen)
        return {};
      return context.plots.figure(
          runs.record->name + "-front-resolutions", front_of_resolutions(runs, *chosen),
          text("Front against time of " + chosen->label + " at all its resolutions."
               + restated(*runs.record, "front")));
    }

    Markup budget(const ReportContext &context, const CaseRuns &runs)
    {
      return context.plots.figure(
          runs.record->name + "-budget", budget_against_time(runs, context.styles),
          text("Defect of the heat budget, relative to its largest term; "
               "drawn at 10⁻¹⁷ where it is less."));
    }

    Markup front_and_heat(const ReportContext &context, const CaseRuns &runs)
    {
      return element("h3", "Front") + front_plots(context, runs)
             + element("h3", "Temperature, solid and heat budget")
             + profiles_of_case(context, runs)
             + pair(budget(context, runs), front_of_all_resolutions(context, runs));
    }

    /** Of a scene without a front; a profile only where one coordinate tells all. */
    Markup temperature_alone(const ReportContext &context, const CaseRuns &runs)
    {
      const CaseRecord &record = *runs.record;
      Markup content;
      if(record.dimension == 1)
        content += profiles_of_case(context, runs);
      if(!record.steady)
        content += budget(context, runs);
      return content.empty() ? content : element("h3", "Temperature") + content;
    }

    Markup parameters(const CaseRuns &runs)
    {
      Table table;
      table.columns
          = {{"parameter", "", false}, {"value", "", false}, {"unit", "", false}};
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
             + linked_csv(context, runs.record->name + "-printed", printed_csv(runs));
    }

    Markup criteria(const ReportContext &context, const CaseRecord &record)
    {
      std::vector<CriterionResult> own;
      for(const CriterionResult &criterion : context.result.criteria)
        if(criterion.case_name == record.name)
          own.push_back(criterion);
      return own.empty()
                 ? Markup()
                 : element("h3", "Acceptance criteria") + criteria_table(own, false);
    }

    Markup limits(const CaseRuns &runs)
    {
      std::vector<Markup> items;
      for(const std::string &limit : runs.record->limits)
        items.push_back(text(limit));
      for(const LabelRuns &label : runs.labels)
        for(const Level &level : label.levels)
          for(const RunRecord *run : level.runs)
            if(run->status != RunStatus::finished)
              items.push_back(text(fmt::format("{}, n = {}: ", run->label, run->n))
                              + (run->status == RunStatus::refused
                                     ? badge("fair", "refused")
                                     : badge("bad", "failed"))
                              + text(" "
                                     + (run->message.empty() ? "no reason was given"
                                                             : run->message)));
      return element("h3", "Limits and omissions")
             + (items.empty() ? element("p", "None are known; every run finished.")
                              : list("ul", items));
    }
  } // namespace

  Markup case_chapter(const ReportContext &context, const CaseRuns &runs)
  {
    const CaseRecord &record = *runs.record;
    std::string tags = record.name;
    for(const std::string &tag : record.tags)
      tags += " · " + tag;
    Markup content = element("p", {{"class", "tags"}}, text(tags))
                     + element("h2", record.title.empty() ? record.name : record.title);
    if(!record.description.empty())
      content += element("p", record.description);
    content += pair(picture(context, runs),
                    element("div", element("h3", "Equations") + equations(record)),
                    "pair scene");
    content += folded("Material", material_table(record));
    if(const Markup effects = effects_of_case(context, runs); !effects.empty())
      content += folded("Effects: on or off, because, share of time, memory", effects);
    content += folded("Schemes and their parameters", parameters(runs))
               + yardstick(context, runs) + element("h3", "Convergence")
               + convergence(context, runs) + error_plots(context, runs)
               + (record.changes_phase ? front_and_heat(context, runs)
                                       : temperature_alone(context, runs))
               + printed(context, runs) + criteria(context, record) + limits(runs);
    return element("section", {{"id", case_anchor(record.name)}}, content) + Markup("\n");
  }
} // namespace meltfront::verification
