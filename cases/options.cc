#include <cases/error.h>
#include <cases/options.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <numeric>

namespace meltfront::cases
{
  namespace
  {
    template <typename Number>
    Number parse_number(const OptionDeclaration &option, const std::string &text,
                        const char *kind)
    {
      Number number{};
      const auto [end, error]
          = std::from_chars(text.data(), text.data() + text.size(), number);
      if(error != std::errc() || end != text.data() + text.size())
        throw InputError(
            fmt::format("option '{}' needs {}, not '{}'", option.key, kind, text));
      if(!(number >= option.lower && number <= option.upper))
        throw InputError(fmt::format("option '{}' must lie within [{}, {}], not {}",
                                     option.key, option.lower, option.upper, text));
      return number;
    }

    OptionValue parse(const OptionDeclaration &option, const std::string &text)
    {
      switch(option.default_value.index())
      {
      case 0:
        if(text == "true" || text == "false")
          return text == "true";
        throw InputError(
            fmt::format("option '{}' needs true or false, not '{}'", option.key, text));
      case 1:
        return parse_number<long>(option, text, "an integer");
      case 2:
        return parse_number<double>(option, text, "a number");
      default:
        if(!option.choices.empty()
           && std::find(option.choices.begin(), option.choices.end(), text)
                  == option.choices.end())
          throw InputError(fmt::format("option '{}' must be one of {}, not '{}'",
                                       option.key, fmt::join(option.choices, ", "),
                                       text));
        return text;
      }
    }

    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for(std::size_t i = 1; i <= a.size(); ++i)
      {
        std::size_t diagonal = row[0]++;
        for(std::size_t j = 1; j <= b.size(); ++j)
        {
          const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
          diagonal = row[j];
          row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
      }
      return row.back();
    }
  } // namespace

  Options::Options(std::vector<OptionDeclaration> declarations)
    : declared(std::move(declarations))
  {
  }

  const OptionDeclaration &Options::declaration(const std::string &key) const
  {
    std::vector<std::string> keys;
    for(const OptionDeclaration &option : declared)
    {
      if(option.key == key)
        return option;
      keys.push_back(option.key);
    }
    throw InputError(keys.empty()
                         ? fmt::format("there is no option '{}'", key)
                         : fmt::format("there is no option '{}'; the nearest is '{}'",
                                       key, nearest_name(key, keys)));
  }

  void Options::set(const std::string &key, const std::string &text)
  {
    overridden[key] = parse(declaration(key), text);
  }

  const OptionValue &Options::value(const std::string &key) const
  {
    const auto found = overridden.find(key);
    return found == overridden.end() ? declaration(key).default_value : found->second;
  }

  bool Options::get_bool(const std::string &key) const
  {
    return std::get<bool>(value(key));
  }

  long Options::get_integer(const std::string &key) const
  {
    return std::get<long>(value(key));
  }

  double Options::get_double(const std::string &key) const
  {
    return std::get<double>(value(key));
  }

  const std::string &Options::get_string(const std::string &key) const
  {
    return std::get<std::string>(value(key));
  }

  std::map<std::string, std::string> Options::values() const
  {
    std::map<std::string, std::string> result;
    for(const OptionDeclaration &option : declared)
      result[option.key] = to_text(value(option.key));
    return result;
  }

  const std::vector<OptionDeclaration> &Options::declarations() const
  {
    return declared;
  }

  std::string to_text(const OptionValue &value)
  {
    return std::visit([](const auto &held) { return fmt::format("{}", held); }, value);
  }

  std::string nearest_name(const std::string &word,
                           const std::vector<std::string> &candidates)
  {
    // What had another name in earlier case files.
    static const std::map<std::string, std::string> renamed{
        {"particles", "cells"},
        {"intervals", "cells"},
        {"step_factor", "cfl"},
        {"largest_move", "cfl"},
        {"absorption", "interpolation_distance"},
        {"homing", "springs"},
        {"marks", "intermediate times"},
        {"picture mark", "picture time number"},
        {"Scene/Heat release", "Scene/Volumetric source"},
        {"heat_release", "volumetric_source"},
        {"wall_transfer", "robin_wall"}};
    const auto now = renamed.find(word);
    if(now != renamed.end()
       && std::find(candidates.begin(), candidates.end(), now->second)
              != candidates.end())
      return now->second;
    // A name that holds the whole word, or is held by it, is nearer than any other.
    const auto rank = [&word](const std::string &name)
    {
      const bool within = std::min(word.size(), name.size()) >= 3
                          && (name.find(word) != std::string::npos
                              || word.find(name) != std::string::npos);
      return std::pair(!within, edit_distance(word, name));
    };
    const auto nearest = std::min_element(candidates.begin(), candidates.end(),
                                          [&rank](const auto &a, const auto &b)
                                          { return rank(a) < rank(b); });
    return nearest == candidates.end() ? std::string() : *nearest;
  }
} // namespace meltfront::cases
