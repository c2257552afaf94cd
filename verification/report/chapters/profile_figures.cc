#include <verification/report/chapters/chapters.h>
#include <verification/report/page/number_text.h>
#include <verification/report/pictures/scene_picture.h>
#include <verification/report/plots/profile_plots.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Marks of an alloy at which some finest run kept a profile. */
    int times_with_profiles(const CaseRuns &runs)
    {
      std::size_t most = 0;
      if(!runs.record->scene.alloy)
        return 0;
      for(const LabelRuns &label : runs.labels)
        if(const RunRecord *run = label.finest())
          most = std::max(most, run->intermediate_profiles.size());
      return static_cast<int>(most);
    }

    /** The sites at the intermediate time of which the case wants a picture. */
    Markup picture_at_intermediate(const ReportContext &context, const CaseRuns &runs)
    {
      const StoredCase &record = *runs.record;
      const RunRecord *run = run_to_picture(runs);
      if(record.measurement.picture_time == 0 || !run
         || run->intermediate_profiles.empty())
        return {};
      const double intermediate
          = record.measurement.intermediate_times.at(record.measurement.picture_time - 1);
      RunRecord shown = *run;
      shown.profile
          = *std::ranges::min_element(run->intermediate_profiles, {},
                                      [intermediate](const RunProfile &profile)
                                      { return std::abs(profile.time - intermediate); });
      return context.plots.figure(
          record.name() + "-mark",
          scene_picture_script(record, {&shown, std::nan(""), {}}),
          "The scene of " + record.name() + " at an intermediate time",
          text(fmt::format(
              "Sites of {} at n = {} at t = {}{}: filled where at least half is "
              "solid, open where liquid.{}",
              run->label, run->n, plain_number(shown.profile.time, 6),
              unit_of(record, " s"), restated(record, "particles"))));
    }

    Markup row_of_figures(const ReportContext &context, const CaseRuns &runs,
                          int intermediate)
    {
      const StoredCase &record = *runs.record;
      const bool end = intermediate == profile_at_end;
      const std::string when
          = end ? "at the end"
                : fmt::format(
                    "at t = {}{}",
                    plain_number(record.measurement.intermediate_times[intermediate], 6),
                    unit_of(record, " s"));
      const auto figure = [&](ProfileQuantity quantity, const std::string &name,
                              const char *what) -> Markup
      {
        const Plot plot = profile_plot(runs, context.styles, quantity, intermediate);
        if(nothing_to_draw(plot))
          return {};
        std::string file = record.name() + "-" + name
                           + (end ? "" : fmt::format("-{}", intermediate + 1));
        std::replace(file.begin(), file.end(), ' ', '-');
        return context.plots.figure(
            file, plot,
            text(fmt::format("{} {}, each method's finest run.{}", what, when,
                             restated(record, name))));
      };
      return element(
                 "div", {{"class", "pair"}},
                 figure(ProfileQuantity::temperature, "temperature", "Temperature")
                     + (!record.scene.changes_phase()
                            ? Markup()
                            : figure(
                                ProfileQuantity::solid_fraction, "solid fraction",
                                "Mass fraction of solid, the share of the latent heat "
                                "that is lost,")))
             + element("div", {{"class", "pair"}},
                       figure(ProfileQuantity::concentration, "concentration",
                              "Mass fraction of solute in the liquid"));
    }
  } // namespace

  Markup profiles_of_case(const ReportContext &context, const CaseRuns &runs)
  {
    Markup content = picture_at_intermediate(context, runs);
    for(int intermediate = 0; intermediate < times_with_profiles(runs); ++intermediate)
      content += row_of_figures(context, runs, intermediate);
    return content + row_of_figures(context, runs, profile_at_end);
  }
} // namespace meltfront::verification
