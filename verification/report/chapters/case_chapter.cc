#include <verification/report/chapters/case_parts.h>
#include <verification/report/chapters/equations.h>
#include <verification/report/pictures/scene_picture.h>
#include <verification/report/pictures/tracked_front.h>
#include <verification/report/plots/case_plots.h>
#include <verification/report/plots/seed_curves.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    Markup picture(const ReportContext &context, const CaseRuns &runs)
    {
      const StoredCase &record = *runs.record;
      const RunRecord *run = run_to_picture(runs);
      const double front = front_at_end(runs);
      const bool exact = std::isfinite(exact_front_at_end(record));
      std::string caption = steady(record)
                                ? "The scene."
                                : fmt::format("The scene at t = {}{}.",
                                              plain_number(record.scene.end_time, 6),
                                              unit_of(record, " s"));
      if(std::isfinite(front))
        caption += fmt::format(" The line is the {} front, at {}{}.",
                               exact ? "exact" : "computed", plain_number(front, 4),
                               unit_of(record, " m"));
      if(run && !record.scene.changes_phase())
        caption += fmt::format(" Sites of {} at n = {}.", run->label, run->n);
      else if(run)
        caption
            += fmt::format(" Sites of {} at n = {}: filled where at least half is solid, "
                           "open where liquid.",
                           run->label, run->n);
      else if(record.scene.changes_phase())
        caption += " Blue: solid; orange: liquid.";
      if(!record.scene.sources.empty())
        caption += " Star: source.";
      if(record.measurement.picture_time == 0)
        caption += restated(record, "particles");
      SceneContent content{run ? run : runs.finest(), front, {}};
      if(const RunRecord *tracked = tracked_run(runs))
      {
        content.tracked = {tracked->frames.back()};
        caption += fmt::format(" Black dots: the front that {} tracked at n = {}.",
                               tracked->label, tracked->n);
      }
      return context.plots.figure(record.name() + "-scene",
                                  scene_picture_script(record, content),
                                  "The scene of " + record.name(), text(caption));
    }

    /** Tracked fronts at the intermediate times and at the end in one picture. */
    Markup front_frames(const ReportContext &context, const CaseRuns &runs)
    {
      const RunRecord *run = tracked_run(runs);
      if(!run || run->frames.size() < 2)
        return {};
      const StoredCase &record = *runs.record;
      std::string times;
      for(const FrontFrame &frame : run->frames)
        times += (times.empty() ? "" : ", ") + plain_number(frame.time, 4);
      SceneContent content;
      content.tracked = run->frames;
      return context.plots.figure(
          record.name() + "-fronts", scene_picture_script(record, content),
          "Fronts over time, " + record.name(),
          text(fmt::format("The front that {} tracked at n = {}, at t = {}{}; black: the "
                           "last.",
                           run->label, run->n, times, unit_of(record, " s"))));
    }

    Markup exact_solution(const StoredCase &record)
    {
      std::string sentence = record.exact->description() + ".";
      sentence[0]
          = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
      Markup content = element("p", sentence);
      const double floor = record.measurement.front_floor;
      if(const double front = exact_front_at_end(record); std::isfinite(front))
        content += element("p", text("Its front at the end: ") + number_markup(front, 8)
                                    + text(unit_of(record, " m") + "."));
      if(floor > 0)
        content
            += element("p", text("In this domain it holds only approximately: no front "
                                 "error below the floor of ")
                                + number_markup(floor, 2)
                                + text(unit_of(record, " m") + " means anything."));
      else if(record.scene.changes_phase())
        content += element("p", "It is exact in this domain: the table has no floor.");
      return content;
    }

    /** The exact solution, or what stands in its place. */
    Markup yardstick(const ReportContext &context, const CaseRuns &runs)
    {
      const StoredCase &record = *runs.record;
      if(record.exact)
        return element("h3", "Exact solution") + exact_solution(record);
      if(record.reference)
        return element("h3", "Reference") + reference_of_case(context, runs);
      return element("h3", "Exact solution")
             + element("p",
                       "There is no exact solution: errors against one cannot be given.");
    }

    /** Of a case that holds the squares against a straight line. */
    Markup front_squared(const ReportContext &context, const CaseRuns &runs)
    {
      if(!runs.has("front_square_slope"))
        return {};
      return context.plots.figure(
          runs.record->name() + "-front-squared",
          front_squared_against_time(runs, context.styles),
          text("Square of the front against time, each method's finest n; where a method "
               "ran with several seeds, their mean and a band of one standard "
               "deviation."));
    }

    Markup front_plots(const ReportContext &context, const CaseRuns &runs)
    {
      return pair(context.plots.figure(
                      runs.record->name() + "-front",
                      front_against_time(runs, context.styles),
                      text("Front against time, each method's finest run.")),
                  context.plots.figure(
                      runs.record->name() + "-front-error",
                      !runs.record->exact
                          ? solid_against_time(runs, context.styles)
                          : front_error_against_time(runs, context.styles),
                      text(!runs.record->exact ? "Volume that is solid against time."
                                               : "Its error against time.")))
             + front_squared(context, runs) + front_frames(context, runs);
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
          runs.record->name() + "-front-resolutions", front_of_resolutions(runs, *chosen),
          text("Front against time of " + chosen->label + " at all its resolutions."
               + restated(*runs.record, "front")));
    }

    Markup budget(const ReportContext &context, const CaseRuns &runs)
    {
      return context.plots.figure(
          runs.record->name() + "-budget", budget_against_time(runs, context.styles),
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
      const StoredCase &record = *runs.record;
      Markup content;
      if(record.scene.domain.dimension == 1)
        content += profiles_of_case(context, runs);
      if(!steady(record))
        content += budget(context, runs);
      return content.empty() ? content : element("h3", "Temperature") + content;
    }

  } // namespace

  Markup case_chapter(const ReportContext &context, const CaseRuns &runs)
  {
    const StoredCase &record = *runs.record;
    if(moves_particles(record))
      return solid_chapter(context, runs);
    if(carries_front(record))
      return advected_chapter(context, runs);
    Markup content = chapter_head(record);
    content += pair(picture(context, runs),
                    element("div", element("h3", "Equations") + equations(record)),
                    "pair scene");
    content += folded("Material", material_table(record));
    content += effects_and_parameters(context, runs) + yardstick(context, runs)
               + element("h3", "Convergence") + convergence(context, runs)
               + error_plots(context, runs)
               + (record.scene.changes_phase() ? front_and_heat(context, runs)
                                               : temperature_alone(context, runs))
               + printed(context, runs) + criteria(context, record) + limits(runs);
    return chapter_of(record, content);
  }
} // namespace meltfront::verification
