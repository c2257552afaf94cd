#include <verification/report/chapters/case_parts.h>
#include <verification/report/chapters/solid_equations.h>
#include <verification/report/pictures/particle_frames.h>
#include <verification/report/plots/solid_plots.h>
#include <verification/report/tables/ensemble_table.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** The run whose frames stand for the case: of its first label that has any. */
    const RunRecord *pictured_run(const CaseRuns &runs)
    {
      for(const LabelRuns &label : runs.labels)
        for(const Level &level : label.levels)
          if(const RunRecord *run = run_with_frames(level.runs))
            return run;
      return nullptr;
    }

    std::string how_drawn(const StoredCase &record, const RunRecord &run)
    {
      const cases::ParticleSolid &solid = *record.scene.particle_solid;
      std::string words
          = fmt::format("{}, n = {}, seed {}. Lines: solid particles nearer than {}; "
                        "points: fluid ones, with an arrow where they move faster than "
                        "7.5 at that moment.",
                        run.label, run.n, run.seed, plain_number(solid.law.cutoff, 4));
      if(solid.dimension() == 3)
        words = fmt::format("{}, n = {}, seed {}, seen from the front, a little from the "
                            "right and from above.",
                            run.label, run.n, run.seed);
      if(solid.light && solid.dimension() == 2)
        words += solid.light->parallel ? " Dashed: the light's direction."
                                       : " Star: where light comes from.";
      if(solid.heating)
        words += " Star: the source; dashed: how far it reaches.";
      if(solid.base && solid.base->hot)
        words += " Thick: the hot part of the base.";
      return words;
    }

    Markup frames(const ReportContext &context, const StoredCase &record,
                  const RunRecord &run)
    {
      const std::string file = "plots/" + plain_name(record.name()) + "-frames.svg";
      write_file(context.directory + "/" + file,
                 frames_as_file(record, run.particle_frames));
      return element("h3", "Frames") + frames_in_page(record, run)
             + element("p", {{"class", "nothing"}},
                       text(how_drawn(record, run)
                            + " A particle is fluid by its average "
                              "speed or its temperature, as said "
                              "above; arrows show the speed that "
                              "the record of the run has. ")
                           + element("a", {{"href", file}}, text("All frames as SVG")));
    }

    /** The run in motion, or its last frame where it cannot be animated. */
    Markup moving_picture(const StoredCase &record, const RunRecord *run)
    {
      if(!run)
        return element("p", {{"class", "nothing"}},
                       text("No finished run has frames to draw."));
      Markup picture = animation_in_page(record, *run);
      if(picture.empty())
      {
        RunRecord last;
        last.particle_frames = {run->particle_frames.back()};
        picture = frames_in_page(record, last);
      }
      return element("figure",
                     picture + element("figcaption", text(how_drawn(record, *run))));
    }

    Markup ensembles(const ReportContext &context, const CaseRuns &runs)
    {
      const std::vector<EnsembleGroup> groups = ensemble(context.result, runs);
      if(groups.empty())
        return {};
      const bool many = std::ranges::any_of(runs.labels,
                                            [](const LabelRuns &label)
                                            {
                                              return std::ranges::any_of(
                                                  label.levels, [](const Level &level)
                                                  { return level.finished_count > 1; });
                                            });
      return element("h3", many ? "What many runs say together" : "Outcomes")
             + (many
                    ? element("p", {{"class", "nothing"}},
                              text("Trajectories are chaotic: a figure of a paper is one "
                                   "draw from a distribution. Shares are means of 0 and "
                                   "1; the last numeric columns count the runs in which "
                                   "the outcome has a value."))
                    : Markup())
             + ensemble_markup(groups)
             + linked_csv(context, runs.record->name(), ensemble_csv(groups));
    }

    /** Which particles are fluid at the end in how many runs. */
    Markup often_fluid(const CaseRuns &runs)
    {
      constexpr std::size_t most = 10;
      const auto level_of = [](const LabelRuns &label) { return label.levels.back(); };
      if(runs.labels.size() != 1 || runs.labels.front().levels.empty())
        return {};
      const Level level = level_of(runs.labels.front());
      std::vector<FluidParticle> particles = fluid_particles(level);
      if(particles.empty() || level.finished_count < 2)
        return {};
      const std::size_t all = particles.size();
      particles.resize(std::min(all, most));
      std::vector<Markup> items;
      for(const FluidParticle &particle : particles)
        items.push_back(
            text(fmt::format("particle {}: {} of {} runs ({:.0f} %)", particle.particle,
                             particle.runs, level.finished_count, 100 * particle.share)));
      return element("div",
                     element("h3", "Most often fluid at the end") + list("ol", items)
                         + (all > most ? element("p", {{"class", "nothing"}},
                                                 text(fmt::format("and {} others, less "
                                                                  "often",
                                                                  all - most)))
                                       : Markup()));
    }

    Markup solid_over_time(const ReportContext &context, const CaseRuns &runs)
    {
      const Plot plot = solid_particles_over_time(runs, context.styles);
      const Markup ranking = often_fluid(runs);
      if(nothing_to_draw(plot))
        return ranking;
      const bool printed
          = std::ranges::any_of(plot.curves, [](const Curve &c) { return !c.line; });
      const Markup figure
          = element("h3", "Solid particles over time")
            + context.plots.figure(
                runs.record->name() + "-solid", plot,
                text(std::string("Mean over the runs; band: one standard deviation.")
                     + (printed ? " Black: the report's frames." : "")));
      return ranking.empty() ? figure : pair(element("div", figure), ranking);
    }

    /** What heats and cools in stages: its energy by its temperature. */
    Markup stages(const ReportContext &context, const CaseRuns &runs)
    {
      const Plot plot = energy_over_temperature(runs, context.styles);
      if(nothing_to_draw(plot))
        return {};
      return element("h3", "Energy against temperature")
             + context.plots.figure(
                 runs.record->name() + "-stages", plot,
                 text("Means over the second half of each stage, joined in the order of "
                      "the stages; bars: one standard deviation over the runs. A step "
                      "between two branches is a latent heat."));
    }

    /** Where energy is conserved: its error by the time step. */
    Markup energy(const ReportContext &context, const CaseRuns &runs)
    {
      const Table table = energy_table(runs);
      if(table.empty())
        return {};
      return element("h3", "Energy")
             + pair(context.plots.figure(
                        runs.record->name() + "-energy",
                        energy_over_time_step(runs, context.styles),
                        text("Largest change of the energy against the time step; grey: "
                             "reference slope.")),
                    table_markup(table));
    }
  } // namespace

  Markup solid_chapter(const ReportContext &context, const CaseRuns &runs)
  {
    const StoredCase &record = *runs.record;
    const RunRecord *run = pictured_run(runs);
    Markup content = chapter_head(record);
    content
        += pair(moving_picture(record, run),
                element("div", element("h3", "What is moved") + solid_equations(record)),
                "pair scene");
    content += effects_and_parameters(context, runs) + ensembles(context, runs)
               + stages(context, runs) + energy(context, runs)
               + solid_over_time(context, runs);
    if(run && run->particle_frames.size() > 1)
      content += frames(context, record, *run);
    return chapter_of(record, content + criteria(context, record) + limits(runs));
  }
} // namespace meltfront::verification
