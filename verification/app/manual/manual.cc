#include <cases/case_file/case_file.h>
#include <cases/case_file/key_list.h>
#include <verification/app/commands.h>
#include <verification/app/manual/case_pages.h>
#include <verification/app/manual/man_page.h>
#include <verification/app/manual/manual.h>
#include <verification/app/manual/markdown.h>
#include <verification/app/manual/method_pages.h>
#include <verification/measure/measure.h>
#include <verification/record/json_values.h>
#include <verification/report/page/page_style.h>
#include <verification/report/plots/gnuplot.h>
#include <verification/report/plots/plot_folder.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>

namespace meltfront::verification
{
  namespace
  {
    constexpr const char *manual_style = R"css(
dl.entries{margin:.6rem 0} dl.entries dt{margin-top:.7rem;overflow-wrap:anywhere}
dl.entries dd{margin:.1rem 0 0 1rem;max-width:74ch}
code{overflow-wrap:anywhere}
h4{font-size:.95rem;margin:1.4rem 0 .3rem} h5{font-size:.9rem;margin:1rem 0 .2rem}
@media screen and (max-width:760px){pre{white-space:pre-wrap;overflow-wrap:anywhere}}
)css";

    Markup entries(const std::vector<std::pair<Markup, Markup>> &list)
    {
      Markup all;
      for(const auto &[term, words] : list)
        all += element("dt", term) + element("dd", words);
      return element("dl", {{"class", "entries"}}, all);
    }

    Markup command_chapter(const std::vector<CommandDescription> &commands)
    {
      Markup all;
      for(const CommandDescription &command : commands)
      {
        std::vector<std::pair<Markup, Markup>> options;
        for(const CommandOption &option : command.options)
        {
          const std::string choices
              = option.choices.empty() || option.is_word
                    ? ""
                    : fmt::format(" One of {}.", fmt::join(option.choices, ", "));
          options.emplace_back(element("code", option.name),
                               text(option.description + "." + choices));
        }
        all += element("h3", {{"id", "command-" + command.name}},
                       element("code", command.name))
               + element("p", command.description + ".")
               + element("p", element("code", usage_of(command)))
               + element("pre", fmt::format("{}", fmt::join(command.examples, "\n")))
               + entries(options);
      }
      return all;
    }

    Markup key_chapter()
    {
      Markup all;
      std::string current = "-";
      std::vector<std::pair<Markup, Markup>> list;
      const auto close = [&]
      {
        if(current != "-")
          all += element("h3", current.empty() ? "Top level" : current) + entries(list);
        list.clear();
      };
      for(const cases::PrmKey &key : cases::case_file_keys())
      {
        if(key.subsection != current)
          close();
        current = key.subsection;
        const std::string name
            = key.count == 0 ? key.key : fmt::format("{} 1 .. {}", key.key, key.count);
        list.emplace_back(
            element("code", name)
                + text(key.default_value.empty() ? "" : " = " + key.default_value),
            text(fmt::format("{} Needs {}.", key.description, key.needs)));
      }
      close();
      return all;
    }

    Markup quantity_chapter()
    {
      std::vector<std::pair<Markup, Markup>> list;
      for(const Quantity &quantity : all_quantities())
        if(!quantity.heading.empty())
          list.emplace_back(
              element("code", quantity.name),
              text(fmt::format("{}{}", quantity.heading,
                               quantity.unit.empty() ? "" : " (" + quantity.unit + ")")));
      return markdown(source_text("verification/measure/QUANTITIES.md"), 3, false)
             + element("details", element("summary", std::string("Columns of the tables"))
                                      + entries(list))
             + element(
                 "details",
                 element("summary", std::string("How they are measured, checks, orders"))
                     + markdown(source_text("verification/measure/README.md"), 3, false));
    }

    Markup page_of(const char *name)
    {
      return markdown(source_text(fmt::format("verification/app/manual/{}.md", name)), 2);
    }

    Markup key_rules()
    {
      return page_of("case-files")
             + element("details",
                       element("summary", std::string("All rules"))
                           + markdown(source_text("cases/case_file/README.md"), 3, false))
             + key_chapter();
    }

    Markup titled(const std::string &title, const Markup &content)
    {
      return element("h2", title) + content;
    }

    struct ManualChapter
    {
      const char *anchor, *word;
      Markup content;
    };

    std::vector<ManualChapter> chapters(const std::vector<CommandDescription> &commands)
    {
      return {
          {"first", "First scene", page_of("first-scene")},
          {"commands", "Commands",
           titled("Commands", page_of("commands") + command_chapter(commands))},
          {"case-files", "Case files", key_rules()},
          {"methods", "Methods", page_of("methods") + method_pages()},
          {"effects", "Effects", titled("Effects", page_of("effects") + effect_table())},
          {"cases", "Cases", titled("Cases of the library", case_pages())},
          {"measures", "Measures", titled("What is measured", quantity_chapter())},
          {"matrices", "Matrices",
           titled(
               "Matrices",
               matrix_pages()
                   + element("details", element("summary", std::string("Matrix files"))
                                            + markdown(source_text("verification/matrix/"
                                                                   "README.md"),
                                                       3, false)))},
          {"results", "Results", page_of("results")},
          {"adding", "Adding", page_of("adding")},
          {"external", "Your own solver",
           markdown(source_text("verification/external/README.md"), 2)},
          {"plugins", "Plugins",
           markdown(source_text("verification/plugins/README.md"), 2)},
          {"installing", "Installing", page_of("installing")},
          {"limits", "Limits", page_of("limits")}};
    }

    std::string html_manual(const std::vector<CommandDescription> &commands)
    {
      Markup links
          = element("a", {{"href", "#first"}, {"class", "mark"}}, text("meltfront"));
      Markup content
          = element("p", {{"class", "kicker"}}, text("meltfront " MELTFRONT_VERSION))
            + element("h1", std::string("The manual"));
      for(const ManualChapter &chapter : chapters(commands))
      {
        links += element("a", {{"href", fmt::format("#{}", chapter.anchor)}},
                         text(chapter.word));
        content += element("section", {{"id", chapter.anchor}}, chapter.content);
      }
      const Markup head
          = page_head("meltfront: the manual") + element("style", Markup(manual_style));
      return (Markup("<!DOCTYPE html>\n")
              + element("html", {{"lang", "en"}},
                        element("head", head)
                            + element("body", marker_definitions()
                                                  + element("nav", element("div", links))
                                                  + element("main", content))))
                 .html()
             + "\n";
    }
  } // namespace

  int manual(const ManualArguments &arguments)
  {
    const bool html = arguments.format == "html";
    const std::string page = html ? html_manual(arguments.commands)
                             : arguments.format == "man"
                                 ? man_page(arguments.commands)
                                 : bash_completion(arguments.commands);
    if(!html && arguments.output.empty())
    {
      std::fputs(page.c_str(), stdout);
      return all_well;
    }
    const std::filesystem::path file
        = arguments.output.empty() ? "results/manual.html" : arguments.output;
    if(file.has_parent_path())
      make_directory(file.parent_path().string());
    write_file(file.string(), page);
    fmt::print("Written to {}\n",
               std::filesystem::absolute(file).lexically_normal().string());
    return all_well;
  }
} // namespace meltfront::verification
