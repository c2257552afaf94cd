#include <cases/case_file/case_file.h>
#include <cases/case_file/key_list.h>
#include <verification/app/capability_list.h>
#include <verification/app/list.h>
#include <verification/app/methods.h>
#include <verification/matrix/matrix_file.h>
#include <verification/measure/measure.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    std::string case_list()
    {
      std::string text = "Cases (meltfront run CASE --method METHOD --n N):\n";
      for(const std::string &name : cases::library_names())
        text += fmt::format("  {:26} {}\n", name, cases::library_title(name));
      return text;
    }

    std::string option_text(const cases::OptionDeclaration &option)
    {
      return fmt::format("      {} = {}\n          {}\n", option.key, value_text(option),
                         option.description);
    }

    /** The names of all keys, a paragraph for each subsection. */
    std::string key_names()
    {
      std::string text = "Keys of a case file (meltfront list keys explains them):\n";
      std::string current = "-";
      for(const cases::PrmKey &key : cases::case_file_keys())
      {
        if(key.subsection != current)
          text += fmt::format("{}  {}: ", current == "-" ? "" : "\n",
                              key.subsection.empty() ? "top level" : key.subsection);
        else
          text += ", ";
        current = key.subsection;
        text += key.count == 0 ? key.key : fmt::format("{} 1 .. {}", key.key, key.count);
      }
      return text + "\n";
    }

    std::string method_list()
    {
      std::string text = "Methods and their options (--set METHOD.KEY=VALUE):\n";
      for(const auto &method : methods())
      {
        text += fmt::format("  {}: {}\n", method->name(), method->summary());
        for(const cases::OptionDeclaration &option : method->option_declarations())
          text += option_text(option);
      }
      return text;
    }

    std::string effect_list()
    {
      std::string text = "Effects (subsection Effects of a case file: auto, on, off):\n";
      for(const cases::Effect effect : cases::all_effects())
        text += fmt::format("  {:22} {}\n", cases::to_string(effect),
                            cases::description(effect));
      return text;
    }

    std::string matrix_list()
    {
      std::string text = "Matrices (meltfront verify MATRIX):\n";
      for(const std::string &name : matrix_names())
        text += fmt::format("  {:22} {}\n", name, load_matrix(name).title);
      return text;
    }
    std::string quantity_list()
    {
      std::string text = "Quantities (columns of the CSV, words of criteria):\n";
      for(const Quantity &quantity : all_quantities())
        text
            += quantity.heading.empty()
                   ? fmt::format("  {}\n", quantity.name)
                   : fmt::format("  {:26} {}{}\n", quantity.name, quantity.heading,
                                 quantity.unit.empty() ? "" : " (" + quantity.unit + ")");
      return text;
    }
  } // namespace

  std::string value_text(const cases::OptionDeclaration &option)
  {
    std::string range;
    if(!option.choices.empty())
      range = fmt::format(", one of {}", fmt::join(option.choices, " | "));
    else if(std::isfinite(option.lower) || std::isfinite(option.upper))
      range = fmt::format(", {} to {}", option.lower, option.upper);
    return fmt::format("{}{}{}{}", cases::to_text(option.default_value),
                       option.unit.empty() || option.unit == "1" ? "" : " ",
                       option.unit == "1" ? "" : option.unit, range);
  }

  std::string list_text(const std::string &what)
  {
    std::string text;
    if(what.empty() || what == "cases")
      text += case_list();
    if(what.empty() || what == "methods")
      text += method_list();
    if(what.empty() || what == "effects")
      text += effect_list();
    if(what.empty() || what == "matrices")
      text += matrix_list();
    if(what.empty())
      text += key_names();
    if(what == "quantities")
      text += quantity_list();
    if(what == "capabilities")
      text += capability_text();
    if(what == "keys")
      text += cases::case_file_reference();
    return text;
  }
} // namespace meltfront::verification
