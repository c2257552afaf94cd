#include <cases/scene.h>
#include <cases/shared_run.h>
#include <verification/app/capability_list.h>
#include <verification/app/methods.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace meltfront::verification
{
  namespace
  {
    template <typename List>
    std::vector<std::string> words_of(const List &list)
    {
      std::vector<std::string> words;
      for(const auto &item : list)
        words.emplace_back(cases::to_string(item));
      return words;
    }

    /** What a method takes, on several ranks too. */
    std::vector<cases::Capabilities> forms_of(const cases::Method &method)
    {
      std::vector<cases::Capabilities> forms = method.capabilities();
      if(const auto *shared = dynamic_cast<const cases::SharedMethod *>(&method))
        forms.push_back(shared->capabilities_on_ranks());
      return forms;
    }

    std::string label_of(const cases::Method &method, const cases::Capabilities &form)
    {
      return form.form.empty() ? method.name()
                               : fmt::format("{} {}", method.name(), form.form);
    }

    /** Rows are methods, columns effects by their number. */
    std::string effect_table()
    {
      const auto &effects = cases::all_effects();
      std::size_t width = 0;
      for(const auto &method : methods())
        for(const cases::Capabilities &form : forms_of(*method))
          width = std::max(width, label_of(*method, form).size());
      std::string text = fmt::format("  {:{}}", "", width);
      for(std::size_t e = 0; e < effects.size(); ++e)
        text += fmt::format(" {:2}", e + 1);
      text += "\n";
      for(const auto &method : methods())
        for(const cases::Capabilities &form : forms_of(*method))
        {
          text += fmt::format("  {:{}}", label_of(*method, form), width);
          for(const cases::Effect effect : effects)
            text += form.takes(effect) ? "  x" : "  .";
          text += "\n";
        }
      for(std::size_t e = 0; e < effects.size(); ++e)
        text += fmt::format("  {:2}  {}\n", e + 1, cases::to_string(effects[e]));
      return text;
    }

    std::string shape_text(const cases::ShapeCapability &shape)
    {
      return fmt::format("{} ({}D; walls: {})", cases::to_string(shape.shape),
                         fmt::join(shape.dimensions, "D, "),
                         fmt::join(words_of(shape.walls), ", "));
    }

    std::string form_text(const cases::Method &method, const cases::Capabilities &form)
    {
      std::string text = fmt::format("  {}\n", label_of(method, form));
      std::string before;
      for(const auto &[heading, words] : capability_facts(form))
      {
        if(heading != "effects") // which the table above shows
          text += fmt::format("      {:10}{}\n", heading == before ? "" : heading + ":",
                              words);
        before = heading;
      }
      return text;
    }

    nlohmann::json form_json(const cases::Capabilities &form)
    {
      nlohmann::json shapes = nlohmann::json::array();
      for(const cases::ShapeCapability &shape : form.shapes)
        shapes.push_back({{"shape", cases::to_string(shape.shape)},
                          {"dimensions", shape.dimensions},
                          {"walls", words_of(shape.walls)}});
      return {
          {"form", form.form},
          {"needs_symmetry", form.needs_symmetry},
          {"needs_particle_solid", form.needs_particle_solid},
          {"problems", words_of(form.problems)},
          {"effects", words_of(form.effects)},
          {"shapes", shapes},
          {"front_origins", words_of(form.front_origins)},
          {"most_fronts", form.most_fronts},
          {"most_threads", form.most_threads},
          {"overshoot",
           {{"at_twenty", form.overshoot.at_twenty}, {"order", form.overshoot.order}}},
          {"conserves_heat", form.conserves_heat}};
    }
  } // namespace

  std::vector<std::pair<std::string, std::string>>
  capability_facts(const cases::Capabilities &form)
  {
    std::vector<std::pair<std::string, std::string>> facts;
    const auto add = [&facts](const char *heading, const std::string &words)
    {
      if(!words.empty())
        facts.emplace_back(heading, words);
    };
    add("problems", fmt::format("{}", fmt::join(words_of(form.problems), ", ")));
    add("effects", fmt::format("{}", fmt::join(words_of(form.effects), ", ")));
    for(const cases::ShapeCapability &shape : form.shapes)
      add("domains", shape_text(shape));
    if(!form.front_origins.empty())
      add("fronts",
          fmt::format("{}{}", fmt::join(words_of(form.front_origins), ", "),
                      form.most_fronts > 0 ? fmt::format("; at most {}", form.most_fronts)
                                           : ""));
    if(form.most_threads < cases::any_number_of_threads)
      add("threads", std::to_string(form.most_threads));
    return facts;
  }

  std::string capability_text()
  {
    std::string text
        = "What each method takes; all else is refused. Effects (x: simulated):\n"
          + effect_table() + "\nDomains, walls and fronts:\n";
    for(const auto &method : methods())
    {
      const auto forms = forms_of(*method);
      if(forms.empty())
        text += fmt::format("  {}\n      what its options say\n", method->name());
      for(const cases::Capabilities &form : forms)
        text += form_text(*method, form);
    }
    return text;
  }

  std::string capability_json()
  {
    nlohmann::json list = nlohmann::json::array();
    for(const auto &method : methods())
    {
      nlohmann::json forms = nlohmann::json::array();
      for(const cases::Capabilities &form : forms_of(*method))
        forms.push_back(form_json(form));
      list.push_back({{"name", method->name()}, {"forms", forms}});
    }
    return nlohmann::json{{"methods", list}}.dump(2) + "\n";
  }
} // namespace meltfront::verification
