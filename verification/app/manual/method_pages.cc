#include <cases/data_folder.h>
#include <cases/effects.h>
#include <verification/app/capability_list.h>
#include <verification/app/list.h>
#include <verification/app/manual/markdown.h>
#include <verification/app/manual/method_pages.h>
#include <verification/app/methods.h>
#include <verification/judge/baseline.h>
#include <verification/matrix/matrix_file.h>
#include <verification/measure/measure.h>
#include <verification/report/page/number_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

namespace meltfront::verification
{
  namespace
  {
    /** The folder whose page tells of the methods whose names begin so. */
    constexpr std::pair<const char *, const char *> folders[]
        = {{"sph", "particles/sph"},
           {"sph-mixture", "particles/sph_mixture"},
           {"sph-two-population", "particles/sph_two_population"},
           {"rkpm", "particles/rkpm"},
           {"rkpm-tracked", "particles/rkpm_tracked"},
           {"moab-integral", "particles/moab_integral"},
           {"voronoi-fv", "particles/voronoi_fv"},
           {"level-set", "particles/level_set"},
           {"greenspan", "particles/greenspan"},
           {"fem-enthalpy", "reference_fem/enthalpy"},
           {"fem-fitted", "reference_fem/fitted"},
           {"fem-cut", "reference_fem/cut"},
           {"external", "verification/external"}};

    std::string folder_of(const std::string &method)
    {
      std::string_view longest, folder;
      for(const auto &[name, its_folder] : folders)
        if(method.starts_with(name) && std::string_view(name).size() > longest.size())
        {
          longest = name;
          folder = its_folder;
        }
      if(folder.empty())
        throw std::logic_error(
            fmt::format("the manual knows no page of the method '{}'", method));
      return std::string(folder);
    }

    /** A page in two: the equations and what goes before, and all behind. */
    std::pair<std::string, std::string> opening_of(const std::string &page)
    {
      std::size_t line = 0;
      while(line < page.size())
      {
        const std::size_t end = std::min(page.find('\n', line), page.size());
        const std::string words = page.substr(line, end - line);
        if(words.starts_with("|")
           || (words.starts_with("## ") && words != "## Equations"))
          break;
        line = end + 1;
      }
      return {page.substr(0, line), page.substr(std::min(line, page.size()))};
    }

    Markup folded(const std::string &words, const Markup &content)
    {
      return element("details", element("summary", words) + content);
    }

    /** The page of a method's folder, once for all methods of the folder. */
    Markup folder_page(const std::string &method, std::set<std::string> &shown)
    {
      const std::string folder = folder_of(method), anchor = "page-" + plain_name(folder);
      if(!shown.insert(folder).second)
        return element("p", text("The same code: ")
                                + element("a", {{"href", "#" + anchor}},
                                          text("equations and rules")));
      const auto [opening, rest] = opening_of(source_text(folder + "/README.md"));
      Markup page = element("div", {{"id", anchor}}, markdown(opening, 4, false));
      if(!rest.empty())
        page += folded("Rules, files and measurements", markdown(rest, 4));
      return page;
    }

    Markup facts_list(const cases::Capabilities &form)
    {
      Markup list;
      std::string before;
      for(const auto &[heading, words] : capability_facts(form))
      {
        list += element("dt", heading == before ? std::string() : heading)
                + element("dd", words);
        before = heading;
      }
      return element("dl", {{"class", "conditions"}}, list);
    }

    Markup capabilities_of(const cases::Method &method)
    {
      const std::vector<cases::Capabilities> forms = method.capabilities();
      if(forms.empty())
        return element("p", std::string("What its options say."));
      Markup all;
      for(const cases::Capabilities &form : forms)
        all += (form.form.empty() ? Markup() : element("h5", form.form))
               + facts_list(form);
      return all;
    }

    Markup options_of(const cases::Method &method)
    {
      Markup list;
      for(const cases::OptionDeclaration &option : method.option_declarations())
        list += element("dt", element("code", method.name() + "." + option.key)
                                  + text(" = " + value_text(option)))
                + element("dd", option.description);
      return list.empty() ? element("p", std::string("None."))
                          : element("dl", {{"class", "entries"}}, list);
    }

    /** A finished run of results/reference: the finest of a case and label. */
    struct Reached
    {
      std::string matrix, case_name, label;
      int n = 0;
      double error = 0, cpu_seconds = 0;
      const Quantity *quantity = nullptr;
    };

    /** The error that tables show first, of those that a run has. */
    void choose_error(const std::map<std::string, double> &figures, Reached &run)
    {
      for(const Quantity &quantity : all_quantities())
        if(const auto found = figures.find(quantity.name);
           found != figures.end() && std::isfinite(found->second)
           && (quantity.error || quantity.from_reference))
        {
          run.quantity = &quantity;
          run.error = found->second;
          return;
        }
    }

    std::vector<Reached> finest_of(const Baseline &baseline)
    {
      std::map<std::pair<std::string, std::string>, Reached> finest;
      for(const auto &[name, runs] : baseline.runs)
      {
        const std::size_t first = name.find('/'), last = name.rfind("/n=");
        const std::string case_name = name.substr(0, first);
        const int n = std::atoi(name.c_str() + last + 3);
        // Varied cases are rows by the hundred.
        if(runs.status != "finished" || case_name.find('[') != std::string::npos)
          continue;
        const std::string label = name.substr(first + 1, last - first - 1);
        Reached &known = finest[{case_name, label}];
        if(n <= known.n)
          continue;
        Reached run{baseline.matrix, case_name, label, n, 0, runs.cpu_seconds, nullptr};
        choose_error(runs.figures, run);
        if(run.quantity)
          known = run;
      }
      std::vector<Reached> list;
      for(const auto &[key, run] : finest)
        if(run.quantity)
          list.push_back(run);
      return list;
    }

    std::string method_of(const std::string &label)
    {
      return label.substr(0, label.find('['));
    }

    /** By method; nothing of matrices that have no committed figures. */
    std::map<std::string, std::vector<Reached>> figures_reached()
    {
      std::map<std::string, std::vector<Reached>> by_method;
      for(const std::string &matrix : matrix_names())
      {
        const std::string file
            = cases::data_path(fmt::format("results/reference/{}.json", matrix));
        if(!std::filesystem::exists(file) || load_matrix(matrix).hard_cases)
          continue;
        for(const Reached &run : finest_of(read_baseline(file)))
          by_method[method_of(run.label)].push_back(run);
      }
      return by_method;
    }

    Markup figures_table(const std::vector<Reached> &runs)
    {
      const auto number = [](const Markup &content) {
        return element("td", {{"class", "number"}}, content);
      };
      Markup rows;
      for(const Reached &run : runs)
        rows += element(
            "tr", element("td", run.matrix) + element("td", run.case_name)
                      + element("td", run.label) + number(text(std::to_string(run.n)))
                      + number(number_text(run.error).markup())
                      + element("td", fmt::format("{}{}", run.quantity->heading,
                                                  run.quantity->unit.empty()
                                                      ? ""
                                                      : " (" + run.quantity->unit + ")"))
                      + number(number_text(run.cpu_seconds, 2).markup()));
      Markup head;
      for(const char *heading :
          {"matrix", "case", "label", "n", "error", "of the", "CPU s"})
        head += element("th", std::string(heading));
      return element("div", {{"class", "scroll plain"}},
                     element("table", element("thead", element("tr", head))
                                          + element("tbody", rows)));
    }
  } // namespace

  Markup method_pages()
  {
    const auto reached = figures_reached();
    std::set<std::string> shown;
    Markup all;
    for(const auto &method : methods())
    {
      Markup page = element("h3", {{"id", "method-" + plain_name(method->name())}},
                            element("code", method->name()))
                    + element("p", method->summary());
      if(!method->corrected_form().empty())
        page += element("p", text("As published; the corrected form is ")
                                 + element("code", method->corrected_form()) + text("."));
      page += folder_page(method->name(), shown)
              + folded("What it takes", capabilities_of(*method))
              + folded("Options", options_of(*method));
      if(const auto found = reached.find(method->name()); found != reached.end())
        page += folded("Figures reached: the finest run of each case in the committed "
                       "results",
                       figures_table(found->second));
      all += page + Markup("\n");
    }
    return all;
  }

  Markup effect_table()
  {
    Markup list;
    for(const cases::Effect effect : cases::all_effects())
    {
      std::vector<std::string> names;
      for(const auto &method : methods())
        if(std::ranges::any_of(method->capabilities(),
                               [effect](const auto &form) { return form.takes(effect); }))
          names.push_back(method->name());
      list += element("dt", element("code", cases::to_string(effect)))
              + element("dd",
                        text(cases::description(effect))
                            + element("div", {{"class", "tags"}},
                                      text(fmt::format("{}", fmt::join(names, ", ")))));
    }
    return element("dl", {{"class", "entries"}}, list);
  }
} // namespace meltfront::verification
