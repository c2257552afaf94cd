#include <cases/error.h>
#include <verification/record/label.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace meltfront::verification
{
  namespace
  {
    std::string without_blanks(std::string text)
    {
      const char *blanks = " \t";
      text.erase(0, text.find_first_not_of(blanks));
      text.erase(text.find_last_not_of(blanks) + 1);
      return text;
    }

    /** What stands between the brackets; empty without any. */
    std::string inside(const std::string &label)
    {
      const std::size_t open = label.find('[');
      if(open == std::string::npos)
        return {};
      return label.substr(open + 1, label.rfind(']') - open - 1);
    }

    void check_brackets(const std::string &label)
    {
      const std::string trimmed = without_blanks(label);
      const auto fail = [&label]
      {
        throw cases::InputError(fmt::format(
            "'{}' is not a label: METHOD or METHOD[KEY=VALUE,KEY=VALUE]", label));
      };
      const auto open = std::ranges::count(trimmed, '[');
      if(open > 1 || open != std::ranges::count(trimmed, ']')
         || (open == 1 && !trimmed.ends_with(']')))
        fail();
      for(const auto &[key, value] : options_of(label))
        if(key.empty() || value.empty())
          fail();
      if(open == 1 && options_of(label).empty())
        fail();
    }

    void check_key(const cases::Options &options, const std::string &key)
    {
      std::vector<std::string> keys;
      for(const cases::OptionDeclaration &declaration : options.declarations())
        keys.push_back(declaration.key);
      if(std::ranges::find(keys, key) == keys.end())
        throw cases::InputError(
            fmt::format("there is no option '{}'; the nearest is '{}'", key,
                        cases::nearest_name(key, keys)));
    }
    /** The values that a value of a pattern stands for: `a|b`. */
    std::vector<std::string> alternatives(const std::string &value)
    {
      std::vector<std::string> values;
      for(std::size_t begin = 0; begin <= value.size();)
      {
        const std::size_t end = std::min(value.find('|', begin), value.size());
        values.push_back(without_blanks(value.substr(begin, end - begin)));
        begin = end + 1;
      }
      return values;
    }
  } // namespace

  std::string method_of(const std::string &label)
  {
    return without_blanks(label.substr(0, label.find('[')));
  }

  std::vector<std::pair<std::string, std::string>> options_of(const std::string &label)
  {
    std::vector<std::pair<std::string, std::string>> options;
    const std::string text = inside(label);
    for(std::size_t begin = 0; begin < text.size();)
    {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      const std::string option = text.substr(begin, end - begin);
      const std::size_t equals = std::min(option.find('='), option.size());
      options.emplace_back(
          without_blanks(option.substr(0, equals)),
          equals < option.size() ? without_blanks(option.substr(equals + 1)) : "");
      begin = end + 1;
    }
    return options;
  }

  std::string canonical_label(const std::string &label)
  {
    auto options = options_of(label);
    if(options.empty())
      return method_of(label);
    std::ranges::sort(options);
    std::string text;
    for(const auto &[key, value] : options)
      text += fmt::format("{}{}={}", text.empty() ? "" : ",", key, value);
    return fmt::format("{}[{}]", method_of(label), text);
  }

  bool label_matches(const std::string &pattern, const std::string &label)
  {
    if(method_of(pattern) != method_of(label))
      return false;
    auto wanted = options_of(pattern), given = options_of(label);
    std::ranges::sort(wanted);
    std::ranges::sort(given);
    return std::ranges::equal(wanted, given,
                              [](const auto &one, const auto &other)
                              {
                                const auto values = alternatives(one.second);
                                return one.first == other.first
                                       && (one.second == any_value
                                           || std::ranges::find(values, other.second)
                                                  != values.end());
                              });
  }

  bool is_family(const std::string &name)
  {
    return name.find('*') != std::string::npos;
  }

  bool in_family(const std::string &family, const std::string &name)
  {
    const std::size_t star = family.find('*');
    if(star == std::string::npos)
      return family == name;
    if(name.compare(0, star, family, 0, star) != 0)
      return false;
    const std::string rest = family.substr(star + 1);
    for(std::size_t end = star; end <= name.size(); ++end)
      if(in_family(rest, name.substr(end)))
        return true;
    return false;
  }

  void check_label(const std::string &label, const MethodLookup &methods)
  {
    check_brackets(label);
    cases::Options options(methods(method_of(label)).option_declarations());
    for(const auto &[key, written] : options_of(label))
      for(const std::string &value : alternatives(written))
      {
        int threads = 0;
        if(value == any_value)
          check_key(options, key);
        else if(key != "threads")
          options.set(key, value);
        else if(std::from_chars(value.data(), value.data() + value.size(), threads).ec
                    != std::errc()
                || threads < 1)
          throw cases::InputError(
              fmt::format("'{}': a run needs at least 1 thread", label));
      }
  }
} // namespace meltfront::verification
