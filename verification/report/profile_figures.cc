#include <verification/report/chapters.h>
#include <verification/report/number_text.h>
#include <verification/report/profile_plots.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    /** Marks at which some finest run kept a profile. */
    int marks_with_profiles(const CaseRuns &runs)
    {
      std::size_t most = 0;
      for(const LabelRuns &label : runs.labels)
        if(const RunRecord *run = label.finest())
          most = std::max(most, run->mark_profiles.size());
      return static_cast<int>(most);
    }

    Markup row_of_figures(const ReportContext &context, const CaseRuns &runs, int mark)
    {
      const CaseRecord &record = *runs.record;
      const bool end = mark == profile_at_end;
      const std::string when
          = end ? "at the end"
                : fmt::format("at t = {}{}",
                              plain_number(record.measurement.marks[mark], 6),
                              unit_of(record, " s"));
      const auto figure = [&](ProfileQuantity quantity, const std::string &name,
                              const char *what) -> Markup
      {
        const Plot plot = profile_plot(runs, context.styles, quantity, mark);
        if(nothing_to_draw(plot))
          return {};
        std::string file
            = record.name + "-" + name + (end ? "" : fmt::format("-{}", mark + 1));
        std::replace(file.begin(), file.end(), ' ', '-');
        return context.plots.figure(
            file, plot,
            text(fmt::format("{} {}, each method's finest run.{}", what, when,
                             restated(record, name))));
      };
      return element("div", {{"class", "pair"}},
                     figure(ProfileQuantity::temperature, "temperature", "Temperature")
                         + figure(ProfileQuantity::solid_fraction, "solid fraction",
                                  "Mass fraction of solid, the share of the latent heat "
                                  "that is lost,"))
             + figure(ProfileQuantity::concentration, "concentration",
                      "Mass fraction of solute in the liquid");
    }
  } // namespace

  Markup profiles_of_case(const ReportContext &context, const CaseRuns &runs)
  {
    Markup content;
    for(int mark = 0; mark < marks_with_profiles(runs); ++mark)
      content += row_of_figures(context, runs, mark);
    return content + row_of_figures(context, runs, profile_at_end);
  }
} // namespace meltfront::verification
