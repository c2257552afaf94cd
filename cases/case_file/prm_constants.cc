#include <cases/case_file/expression.h>
#include <cases/case_file/prm_constants.h>
#include <cases/case_file/prm_scan.h>
#include <cases/case_file/value_units.h>
#include <cases/error.h>
#include <cases/expression_words.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>

namespace meltfront::cases
{
  namespace
  {
    bool is_letter(char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
    }

    bool in_name(char c)
    {
      return is_letter(c) || std::isdigit(static_cast<unsigned char>(c));
    }

    void check_constant_name(const std::string &name)
    {
      if(name.empty() || !is_letter(name[0]) || !std::ranges::all_of(name, in_name))
        throw InputError(
            "is no name of a constant: letters, digits and '_', a letter first");
      const std::vector<std::string> variables{"x", "y", "z", "t", "T", "C", "phi", "pi"};
      if(std::ranges::find(variables, name) != variables.end())
        throw InputError(
            "cannot be a constant: expressions have a variable of this name");
      const auto &functions = expression_functions();
      if(std::ranges::find(functions, name) != functions.end())
        throw InputError("cannot be a constant: it is a function of expressions");
    }

    /** The parts between a list's commas, each changed by a function. */
    PlainFormula each_part(const std::string &list,
                           const std::function<PlainFormula(const std::string &)> &change)
    {
      PlainFormula all;
      for(const std::string &part : split_list(list, ','))
      {
        const PlainFormula changed = change(part);
        all.text += (all.text.empty() ? "" : ", ") + changed.text;
        all.units.insert(all.units.end(), changed.units.begin(), changed.units.end());
      }
      return all;
    }

    double number_of_formula(const std::string &formula)
    {
      return parse_field(formula, "")({}, 0);
    }
  } // namespace

  bool PrmConstants::named_in(const std::string &formula) const
  {
    return !is_number_with_unit(formula)
           && std::ranges::any_of(names_in(formula), [this](const std::string &name)
                                  { return constants.contains(name); });
  }

  PlainFormula PrmConstants::replaced(const std::string &formula)
  {
    PlainFormula plain;
    for(std::size_t i = 0; i < formula.size();)
    {
      std::size_t end = i;
      while(end < formula.size() && in_name(formula[end]))
        ++end;
      const std::string word = formula.substr(i, std::max<std::size_t>(end - i, 1));
      i += word.size();
      // What stands behind a digit or a point is a number's exponent.
      const std::size_t begin = i - word.size();
      const bool within_number
          = begin > 0 && (formula[begin - 1] == '.' || in_name(formula[begin - 1]));
      const auto found = constants.find(word);
      if(within_number || found == constants.end())
      {
        plain.text += word;
        continue;
      }
      used.insert(word);
      plain.text += fmt::format("({:.17g})", found->second.number);
      if(!found->second.unit.empty())
        plain.units.push_back(found->second.unit);
    }
    return plain;
  }

  void PrmConstants::set(const std::string &name, const std::string &value)
  {
    check_constant_name(name);
    const PlainValue plain = without_units(value);
    if(plain.unit.empty() && value.find(',') != std::string::npos
       && value.find('(') == std::string::npos)
      throw InputError("needs one number, not several");
    Constant constant{value, plain.unit, 0};
    if(!plain.unit.empty())
      constant.number = number_of_formula(plain.text);
    else
    {
      constant.number = number_of_formula(replaced(value).text);
      constant.given = fmt::format("{:.17g}", constant.number);
    }
    constants[name] = constant;
  }

  PlainFormula PrmConstants::in_numbers(const std::string &value)
  {
    return each_part(
        value,
        [this](const std::string &part) -> PlainFormula
        {
          if(const auto found = constants.find(part); found != constants.end())
          {
            used.insert(part);
            return {found->second.given, {}};
          }
          if(!named_in(part))
            return {part, {}};
          PlainFormula formula = replaced(part);
          formula.text = fmt::format("{:.17g}", number_of_formula(formula.text));
          return formula;
        });
  }

  PlainFormula PrmConstants::in_expressions(const std::string &value)
  {
    return each_part(value,
                     [this](const std::string &part) -> PlainFormula
                     {
                       if(const auto found = constants.find(part);
                          found != constants.end())
                       {
                         used.insert(part);
                         return {found->second.given, {}};
                       }
                       return replaced(part);
                     });
  }

  std::vector<std::string> PrmConstants::unused() const
  {
    std::vector<std::string> names;
    for(const auto &[name, constant] : constants)
      if(!used.contains(name))
        names.push_back(name);
    return names;
  }
} // namespace meltfront::cases
