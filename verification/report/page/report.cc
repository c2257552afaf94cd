#include <verification/report/page/report.h>

#include <verification/report/chapters/chapters.h>
#include <verification/report/page/page_style.h>
#include <verification/report/plots/gnuplot.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/ensemble_table.h>

#include <span>

namespace meltfront::verification
{
  namespace
  {
    std::vector<std::string> labels_of(const MatrixResult &result)
    {
      std::vector<std::string> labels;
      for(const RunRecord &run : result.runs)
        labels.push_back(run.label);
      return labels;
    }

    bool is_variation(const CaseRuns &runs)
    {
      return !runs.record->variation.empty();
    }

    /** The varied cases, or the others. */
    std::vector<CaseRuns> chosen(std::vector<CaseRuns> runs, bool variations)
    {
      std::erase_if(runs, [variations](const CaseRuns &one)
                    { return is_variation(one) != variations; });
      return runs;
    }

    // A chapter is a line here; it is left out where it has nothing to show.
    constexpr Chapter before_cases[] = {{"answers", "Answers", answers_chapter},
                                        {"stability", "Stability", stability_chapter},
                                        {"ablation", "Without", ablation_chapter},
                                        {"findings", "Findings", findings_chapter},
                                        {"variations", "Variations", variations_chapter},
                                        {"cost", "Cost", cost_chapter},
                                        {"effects", "Effects", effects_chapter},
                                        {"orders", "Orders", orders_chapter},
                                        {"coverage", "Error bars", coverage_chapter}};
    constexpr Chapter after_cases[] = {{"provenance", "Provenance", provenance_chapter}};

    Markup navigation_link(const std::string &anchor, const std::string &words)
    {
      return element("a", {{"href", "#" + anchor}}, text(words));
    }

    /** The sections of chapters; their links are added to the navigation. */
    Markup sections(const ReportContext &context, std::span<const Chapter> chapters,
                    Markup &links)
    {
      Markup all;
      for(const Chapter &chapter : chapters)
        if(const Markup content = chapter.content(context); !content.empty())
        {
          links += navigation_link(chapter.anchor, chapter.word);
          all += element("section", {{"id", chapter.anchor}}, content);
        }
      return all;
    }

    /** Navigation and chapters. */
    Markup body(const ReportContext &context)
    {
      Markup links
          = element("a", {{"href", "#verdict"}, {"class", "mark"}}, text("meltfront"));
      Markup chapters = verdict_chapter(context) + sections(context, before_cases, links);
      const Markup last = sections(context, after_cases, links);
      if(!context.runs.empty())
        links += element("span", {{"class", "bar"}}, Markup());
      for(const CaseRuns &runs : context.runs)
      {
        const std::string &name = runs.record->name();
        links += navigation_link(case_anchor(name), name);
        chapters += case_chapter(context, runs);
      }
      return element("nav", element("div", links)) + element("main", chapters + last);
    }

    /** Markdown and TeX; the CSV is written where the page links to it. */
    void write_text_tables(const ReportContext &context)
    {
      for(const CaseRuns &runs : context.runs)
      {
        const std::string file
            = context.directory + "/tables/" + plain_name(runs.record->name());
        const bool solid = moves_particles(*runs.record);
        const std::vector<EnsembleGroup> groups
            = solid ? ensemble(context.result, runs) : std::vector<EnsembleGroup>();
        const Table table = solid ? ensemble_table(groups) : convergence_table(runs);
        const Table printed = solid ? Table() : printed_table(runs);
        std::string markdown = table_markdown(table), tex = table_tex(table);
        if(!printed.empty())
        {
          markdown += '\n';
          markdown += table_markdown(printed);
          tex += '\n';
          tex += table_tex(printed);
        }
        write_file(file + ".csv", solid ? ensemble_csv(groups) : convergence_csv(runs));
        write_file(file + ".md", markdown);
        write_file(file + ".tex", tex);
      }
    }

    Markup page(const ReportContext &context)
    {
      const Markup head = page_head("meltfront: " + context.result.name);
      return Markup("<!DOCTYPE html>\n")
             + element("html", {{"lang", "en"}},
                       element("head", head) + Markup("\n")
                           + element("body", marker_definitions() + body(context)));
    }
  } // namespace

  void write_report(const MatrixResult &result, const std::string &directory)
  {
    make_directory(directory + "/tables");
    make_directory(directory + "/plots");
    const std::vector<CaseRuns> all = collect_runs(result);
    const ReportContext context{result,
                                chosen(all, false),
                                chosen(all, true),
                                MethodStyles(labels_of(result)),
                                PlotFolder(directory + "/plots"),
                                directory};
    write_text_tables(context);
    write_file(directory + "/report.html", page(context).html() + "\n");
  }
} // namespace meltfront::verification
