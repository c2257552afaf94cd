#include <cases/case_file/case_file.h>
#include <cases/data_folder.h>
#include <verification/app/manual/case_pages.h>
#include <verification/app/methods.h>
#include <verification/judge/baseline.h>
#include <verification/matrix/matrix_file.h>
#include <verification/record/stored_case.h>
#include <verification/report/page/case_runs.h>
#include <verification/report/page/number_text.h>
#include <verification/report/pictures/advected_picture.h>
#include <verification/report/pictures/scene_picture.h>
#include <verification/report/plots/gnuplot.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    /** What a newcomer meets first. */
    constexpr const char *first_tag = "first";

    /** The matrices that run a case, by its name. */
    std::map<std::string, std::set<std::string>> matrices_by_case()
    {
      std::map<std::string, std::set<std::string>> found;
      for(const std::string &matrix : matrix_names())
        for(const PlannedCase &planned : planned_cases(load_matrix(matrix)))
          found[short_case_name(planned.base)].insert(matrix);
      return found;
    }

    /** The scene as it is before any run; nothing for particles, which have no domain. */
    Markup picture_of(const StoredCase &record)
    {
      if(moves_particles(record))
        return {};
      if(carries_front(record))
        return record.scene.domain.dimension == 2
                   ? inline_svg(run_gnuplot(advected_interface_script(record, {})),
                                "The scene of " + record.name())
                   : Markup();
      const SceneContent content{nullptr, exact_front_at_end(record), {}};
      return inline_svg(run_gnuplot(scene_picture_script(record, content)),
                        "The scene of " + record.name());
    }

    Markup case_entry(const cases::Case &c, const std::set<std::string> &matrices)
    {
      const StoredCase record = stored_case(c);
      Markup entry
          = element("h3", {{"id", "case-" + plain_name(c.scene.name)}},
                    element("code", c.scene.name))
            + element("p", element("b", c.title)
                               + text(c.description.empty() ? "" : ": " + c.description));
      if(const Markup picture = picture_of(record); !picture.empty())
        entry += element("figure", {{"class", "plot"}}, picture);
      if(!c.limits.empty())
      {
        std::vector<Markup> items;
        for(const std::string &limit : c.limits)
          items.push_back(text(limit));
        entry += list("ul", items);
      }
      return entry
             + element("p", {{"class", "tags"}},
                       text(fmt::format("{}{}", fmt::join(c.tags, ", "),
                                        matrices.empty()
                                            ? ""
                                            : fmt::format("{}matrix {}",
                                                          c.tags.empty() ? "" : " · ",
                                                          fmt::join(matrices, ", ")))))
             + Markup("\n");
    }

    std::string seconds_of(const std::string &matrix)
    {
      const std::string file
          = cases::data_path(fmt::format("results/reference/{}.json", matrix));
      if(!std::filesystem::exists(file))
        return "";
      double seconds = 0;
      for(const auto &[name, runs] : read_baseline(file).runs)
        seconds += runs.cpu_seconds;
      return fmt::format("; {} of CPU time when it was last committed",
                         duration_text(seconds));
    }
  } // namespace

  Markup case_pages()
  {
    const auto matrices = matrices_by_case();
    Markup first, others;
    for(const std::string &name : cases::library_names())
    {
      const cases::Case c = cases::load_case(name);
      const auto found = matrices.find(name);
      const Markup entry = case_entry(c, found == matrices.end() ? std::set<std::string>()
                                                                 : found->second);
      (std::ranges::find(c.tags, first_tag) != c.tags.end() ? first : others) += entry;
    }
    return element("h3", std::string("To meet first")) + first
           + element("h3", std::string("All others"))
           + element("details", element("summary", std::string("Show them")) + others);
  }

  Markup matrix_pages()
  {
    Markup entries;
    for(const std::string &name : matrix_names())
    {
      const Matrix matrix = load_matrix(name);
      std::set<std::string> labels;
      for(const PlannedRun &run : plan_runs(matrix, method_named))
        labels.insert(run.method);
      std::vector<std::string> names;
      for(const std::string &one : case_names(matrix))
        names.push_back(short_case_name(one));
      entries += element("dt", element("code", cases::program_call() + " verify " + name))
                 + element("dd",
                           element("b", matrix.title) + text(". " + matrix.description)
                               + element("div", {{"class", "tags"}},
                                         text(fmt::format(
                                             "{} runs; {}; {}{}",
                                             plan_runs(matrix, method_named).size(),
                                             fmt::join(labels, ", "),
                                             fmt::join(names, ", "), seconds_of(name)))));
    }
    return element("dl", {{"class", "entries"}}, entries);
  }
} // namespace meltfront::verification
