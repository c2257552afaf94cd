#include <verification/report/chapters/case_parts.h>
#include <verification/report/chapters/solid_equations.h>
#include <verification/report/pictures/advected_picture.h>
#include <verification/report/plots/case_plots.h>
#include <verification/report/tables/step_cost.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    /** The fronts of a run over the exact ones, at the intermediate times and at the end.
     */
    Markup fronts(const ReportContext &context, const CaseRuns &runs,
                  const LabelRuns &label, const std::string &name)
    {
      const RunRecord *run = label.finest();
      if(!run || (run->frames.empty() && runs.record->scene.domain.dimension != 2))
        return {};
      return context.plots.figure(
          name, advected_interface_script(*runs.record, run->frames),
          "Fronts of " + label.label + " over the exact ones, " + runs.record->name(),
          text(fmt::format("{}, n = {}{}.", label.label, run->n,
                           run->frames.empty() ? ": no points of its front were kept"
                                               : "")));
    }

    Markup all_fronts(const ReportContext &context, const CaseRuns &runs)
    {
      Markup figures;
      int number = 0;
      for(const LabelRuns &label : runs.labels)
        figures += fronts(context, runs, label,
                          fmt::format("{}-fronts-{}", runs.record->name(), ++number));
      if(figures.empty())
        return {};
      return element("h3", "Fronts over the exact ones")
             + element("p", {{"class", "nothing"}},
                       text(fmt::format("Lines: exact, at t = {}; black: at the end. "
                                        "Points: those that each method's finest run "
                                        "found on its front at these times.",
                                        advected_interface_times(*runs.record))))
             + element("div", {{"class", "multiples wide"}}, figures);
    }

    Markup volume(const ReportContext &context, const CaseRuns &runs)
    {
      Plot plot = solid_against_time(runs, context.styles);
      plot.description = "Area of the region against time, " + runs.record->name();
      plot.y.label = "area";
      if(nothing_to_draw(plot))
        return {};
      return context.plots.figure(
          runs.record->name() + "-volume", plot,
          text("Area of the region against time, each method's finest run."));
    }

    Markup step_cost(const CaseRuns &runs)
    {
      const Table table = step_cost_table(runs);
      if(table.empty())
        return {};
      return element("h3", "What a step costs")
             + element("p", {{"class", "nothing"}},
                       text("Processor time of the fastest run. A front of given length "
                            "crosses a number of cells that grows as n in the plane and "
                            "as n² in space; the whole grid grows as n² and n³."))
             + table_markup(table);
    }
  } // namespace

  Markup advected_chapter(const ReportContext &context, const CaseRuns &runs)
  {
    const StoredCase &record = *runs.record;
    Markup content = chapter_head(record);
    const Markup scene
        = record.scene.domain.dimension != 2
              ? Markup()
              : context.plots.figure(
                  record.name() + "-scene", advected_interface_script(record, {}),
                  "The region of " + record.name(),
                  text(fmt::format("The exact front at t = {}; black: at the end.",
                                   advected_interface_times(record))));
    const Markup equations
        = element("div", element("h3", "Equations") + advection_equations(record));
    content += scene.empty() ? equations : pair(scene, equations, "pair scene");
    content += effects_and_parameters(context, runs) + element("h3", "Convergence")
               + element("p", {{"class", "nothing"}},
                         text("A point is inside at a time if its path, followed back, "
                              "started inside. Mismatch: what is missing of the exact "
                              "region and what lies outside it, over its volume; front, "
                              "L1: the same over the length of the front, in spacings. "
                              "Normals and curvature are compared where the exact front "
                              "is smooth and the motion rigid or undone."))
               + convergence(context, runs) + error_plots(context, runs) + step_cost(runs)
               + volume(context, runs) + all_fronts(context, runs)
               + printed(context, runs) + criteria(context, record) + limits(runs);
    return chapter_of(record, content);
  }
} // namespace meltfront::verification
