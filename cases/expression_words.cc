#include <cases/expression_words.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace meltfront::cases
{
  namespace
  {
    bool starts_name(char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
    }

    bool is_digit(char c)
    {
      return std::isdigit(static_cast<unsigned char>(c));
    }

    /** Position after the number that begins at a position. */
    std::size_t skip_number(const std::string &text, std::size_t at)
    {
      while(at < text.size() && (is_digit(text[at]) || text[at] == '.'))
        ++at;
      if(at < text.size() && (text[at] == 'e' || text[at] == 'E'))
      {
        std::size_t exponent = at + 1;
        if(exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-'))
          ++exponent;
        if(exponent < text.size() && is_digit(text[exponent]))
          at = exponent;
        while(at < text.size() && is_digit(text[at]))
          ++at;
      }
      return at;
    }

    /** Call back with every name and every number of a text. */
    template <typename Name, typename Number>
    void visit_words(const std::string &text, const Name &name, const Number &number)
    {
      for(std::size_t i = 0; i < text.size();)
      {
        const std::size_t begin = i;
        if(is_digit(text[i]) || text[i] == '.')
        {
          i = std::max(skip_number(text, i), i + 1);
          number(text.substr(begin, i - begin));
        }
        else if(starts_name(text[i]))
        {
          while(i < text.size() && (starts_name(text[i]) || is_digit(text[i])))
            ++i;
          name(text.substr(begin, i - begin));
        }
        else
          ++i;
      }
    }

    /** The end of a function's first argument, which begins at a position. */
    std::size_t end_of_argument(const std::string &text, std::size_t at)
    {
      for(int depth = 0; at < text.size(); ++at)
      {
        if(depth == 0 && (text[at] == ',' || text[at] == ')'))
          break;
        depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
      }
      return at;
    }
  } // namespace

  const std::vector<std::string> &expression_functions()
  {
    // Those of deal.II's parser; it has no erf: 1 - erfc serves.
    static const std::vector<std::string> functions{
        "sin",  "cos",  "tan", "asin", "acos", "atan",  "atan2", "sinh",
        "cosh", "tanh", "exp", "ln",   "log",  "log10", "sqrt",  "abs",
        "min",  "max",  "pow", "erfc", "if",   "floor", "ceil",  "sign"};
    return functions;
  }

  std::vector<std::string> names_in(const std::string &expression)
  {
    std::vector<std::string> names;
    visit_words(
        expression, [&](const std::string &name) { names.push_back(name); },
        [](const std::string &) {});
    return names;
  }

  std::vector<double> numbers_in(const std::string &expression)
  {
    std::vector<double> numbers;
    visit_words(
        expression, [](const std::string &) {},
        [&](const std::string &number)
        { numbers.push_back(std::strtod(number.c_str(), nullptr)); });
    return numbers;
  }

  bool is_table(const std::string &value)
  {
    return value.find(':') != std::string::npos && value.find('?') == std::string::npos;
  }

  bool may_depend_on(const std::string &expression, const std::string &variables)
  {
    const std::vector<std::string> names = names_in(expression);
    if(names.empty())
      return numbers_in(expression).empty(); // no words at all
    const std::vector<std::string> &functions = expression_functions();
    return std::ranges::any_of(
        names,
        [&](const std::string &name)
        {
          if(name.size() == 1)
            return variables.find(name) != std::string::npos
                   || std::string("xyzt").find(name) == std::string::npos;
          return name != "pi" && std::ranges::find(functions, name) == functions.end();
        });
  }

  bool may_jump_with(const std::string &expression, const std::string &variables)
  {
    if(is_table(expression) || !may_depend_on(expression, variables))
      return false;
    // Of a function that jumps only its argument counts, of an operator all.
    std::string rest = expression;
    for(const std::string word : {"if", "floor", "ceil", "sign"})
      for(std::size_t at = rest.find(word); at != std::string::npos;
          at = rest.find(word, at + 1))
      {
        const std::size_t open = rest.find_first_not_of(' ', at + word.size());
        const bool is_call
            = open != std::string::npos && rest[open] == '('
              && (at == 0 || !(starts_name(rest[at - 1]) || is_digit(rest[at - 1])));
        if(!is_call)
          continue;
        const std::size_t end = end_of_argument(rest, open + 1);
        if(may_depend_on(rest.substr(open + 1, end - open - 1), variables))
          return true;
        std::fill(rest.begin() + static_cast<std::ptrdiff_t>(open) + 1,
                  rest.begin() + static_cast<std::ptrdiff_t>(end), ' ');
      }
    return rest.find_first_of("<>=!?&|") != std::string::npos;
  }
} // namespace meltfront::cases
