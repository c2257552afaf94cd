#include <cases/case_file/expression.h>
#include <cases/case_file/prm_scan.h>
#include <cases/error.h>
#include <cases/expression_words.h>
#include <cases/options.h>
#include <cases/property_curve.h>

#include <deal.II/base/function_parser.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>

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

    /**
     * A comma may only separate the arguments of a function: the parser itself would read
     * `0,5` as 5.
     */
    void check_commas(const std::string &text)
    {
      std::vector<bool> calls; // for every open bracket: does it hold arguments?
      char before = ' ';
      for(const char c : text)
      {
        if(c == '(')
          calls.push_back(starts_name(before) || is_digit(before));
        else if(c == ')' && !calls.empty())
          calls.pop_back();
        else if(c == ',' && (calls.empty() || !calls.back()))
          throw InputError("holds a comma that separates no arguments of a function");
        if(c != ' ' && c != '\t')
          before = c;
      }
    }

    void check_characters(const std::string &text)
    {
      constexpr std::size_t longest = 1000;
      if(text.empty())
        throw InputError("needs an expression, not an empty one");
      if(text.size() > longest)
        throw InputError(fmt::format("is longer than {} characters", longest));
      for(std::size_t i = 0; i < text.size(); ++i)
      {
        const char c = text[i];
        if(!starts_name(c) && !is_digit(c)
           && std::string(" \t.+-*/^()<>=!&|?:,").find(c) == std::string::npos)
          throw InputError(fmt::format("holds '{}', which no expression does",
                                       quotable(text.substr(i, 1))));
        const bool compares = (i > 0 && std::string("<>=!").find(text[i - 1]) < 4)
                              || (i + 1 < text.size() && text[i + 1] == '=');
        if(c == '=' && !compares)
          throw InputError("holds a single '=', which assigns and does not compare");
      }
      check_commas(text);
    }

    void check_names(const std::vector<std::string> &names,
                     const std::vector<std::string> &variables)
    {
      std::vector<std::string> valid = expression_functions();
      valid.push_back("pi");
      valid.insert(valid.end(), variables.begin(), variables.end());
      for(const std::string &name : names)
        if(std::find(valid.begin(), valid.end(), name) == valid.end())
        {
          const bool other = name == "x" || name == "y" || name == "z" || name == "t";
          throw InputError(
              other ? fmt::format("depends on {}, which it may not here", name)
                    : fmt::format("holds the unknown name '{}'; the nearest is '{}'",
                                  quotable(name), nearest_name(name, valid)));
        }
    }

    /** Keeps the standard error stream silent: deal.II prints what its parser says. */
    class SilentErrors
    {
    public:
      SilentErrors()
        : kept(std::cerr.rdbuf(nothing.rdbuf()))
      {
      }

      ~SilentErrors()
      {
        std::cerr.rdbuf(kept);
      }

      SilentErrors(const SilentErrors &) = delete;
      SilentErrors &operator=(const SilentErrors &) = delete;

    private:
      std::ostringstream nothing;
      std::streambuf *kept;
    };

    /** A formula of x, y, z, t; may be evaluated by several threads at once. */
    class Formula : private dealii::FunctionParser<3>
    {
    public:
      explicit Formula(const std::string &text)
      {
        initialize("x,y,z,t", text, {{"pi", std::numbers::pi}}, true);
      }

      double value(const Position &p, double time) const
      {
        return do_value({p[0], p[1], p[2]}, time, 0);
      }
    };

    /** A formula of one variable; may be evaluated by several threads at once. */
    class FunctionOfOne : private dealii::FunctionParser<1>
    {
    public:
      FunctionOfOne(const std::string &text, const std::string &variable)
      {
        initialize(variable, text, {{"pi", std::numbers::pi}});
      }

      double value(double argument) const
      {
        return do_value(dealii::Point<1>(argument), 0, 0);
      }
    };

    double read_number(const std::string &text)
    {
      double value = 0;
      const char *end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data(), end, value);
      if(text.empty() || error != std::errc() || stop != end || !std::isfinite(value))
        throw InputError(fmt::format("holds '{}', which is no number", quotable(text)));
      return value;
    }

    /** A few of a table's points, after the one variable that it depends on. */
    std::string words_of(const std::vector<std::pair<double, double>> &points)
    {
      constexpr std::size_t most = 6;
      std::string words = "t: ";
      for(std::size_t i = 0; i < points.size(); ++i)
        if(points.size() <= most || i + 1 < most / 2 || i + 1 == points.size())
          words += fmt::format("{}{:.10g}: {:.10g}", i == 0 ? "" : ", ", points[i].first,
                               points[i].second);
        else if(i + 1 == most / 2)
          words += ", ...";
      return words;
    }

    Field table_over_time(const std::string &text)
    {
      const std::vector<std::pair<double, double>> points
          = parse_points(text, "time: value");
      std::vector<double> times, values;
      for(const auto &[time, value] : points)
      {
        times.push_back(time);
        values.push_back(value);
      }
      const auto curve = std::make_shared<const PropertyCurve>(times, values, text);
      return {words_of(points),
              [curve](const Position &, double time) { return (*curve)(time); }, false,
              times};
    }

    /** What the parser says, on one line. */
    std::string reason(const dealii::ExceptionBase &error)
    {
      std::ostringstream stream;
      error.print_info(stream);
      std::string text = trimmed(stream.str());
      std::replace(text.begin(), text.end(), '\n', ' ');
      while(!text.empty() && (text.back() == ' ' || text.back() == '.'))
        text.pop_back();
      return text;
    }
  } // namespace

  Field parse_field(const std::string &expression, const std::string &variables)
  {
    if(is_table(expression))
    {
      if(variables.find('t') == std::string::npos)
        throw InputError("cannot be a table: it does not depend on the time");
      return table_over_time(expression);
    }
    check_characters(expression);
    const std::vector<std::string> names = names_in(expression);
    std::vector<std::string> letters;
    for(const char c : variables)
      letters.emplace_back(1, c);
    check_names(names, letters);
    const SilentErrors silent;
    try
    {
      const auto formula = std::make_shared<const Formula>(expression);
      const double probe = formula->value({}, 0);
      const bool constant
          = std::none_of(names.begin(), names.end(),
                         [](const std::string &name) { return name.size() == 1; });
      if(!constant)
        return {expression,
                [formula](const Position &p, double time)
                { return formula->value(p, time); },
                false};
      if(!std::isfinite(probe))
        throw InputError(fmt::format("is not a finite number but {}", probe));
      Field field = Field::uniform(probe);
      field.expression = expression;
      return field;
    }
    catch(const dealii::ExceptionBase &error)
    {
      throw InputError(fmt::format("cannot be parsed: {}", reason(error)));
    }
  }

  std::function<double(double)> parse_function(const std::string &expression,
                                               const std::string &variable)
  {
    check_characters(expression);
    check_names(names_in(expression), {variable});
    const SilentErrors silent;
    try
    {
      const auto formula = std::make_shared<const FunctionOfOne>(expression, variable);
      formula->value(0); // a text that cannot be parsed shows when it is first evaluated
      return [formula](double argument) { return formula->value(argument); };
    }
    catch(const dealii::ExceptionBase &error)
    {
      throw InputError(fmt::format("cannot be parsed: {}", reason(error)));
    }
  }

  std::vector<std::pair<double, double>> parse_points(const std::string &text,
                                                      const std::string &form)
  {
    std::vector<std::pair<double, double>> points;
    for(const std::string &point : split_list(text, ','))
    {
      const std::vector<std::string> parts = split_list(point, ':');
      if(parts.size() != 2)
        throw InputError(fmt::format("needs points '{}' separated by commas, not '{}'",
                                     form, quotable(point)));
      points.emplace_back(read_number(parts[0]), read_number(parts[1]));
    }
    return points;
  }

  std::function<double(double)> integral_from(std::function<double(double)> function,
                                              double start, double end,
                                              const std::vector<double> &breakpoints)
  {
    constexpr int panels = 64;
    std::vector<double> edges = breakpoints;
    std::erase_if(edges, [=](double time) { return !(time > start && time < end); });
    for(int i = 0; i <= panels; ++i)
      edges.push_back(start + (end - start) * i / panels);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    // Scaled to the unit interval: Boost compares errors there with a tolerance that
    // knows the interval's length, which short intervals could never meet.
    const auto over = [function = std::move(function)](double from, double to)
    {
      constexpr unsigned deepest = 8;
      constexpr double tolerance = 1e-12;
      const double length = to - from;
      return length
             * boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
                 [&function, from, length](double share)
                 { return function(from + share * length); },
                 0., 1., deepest, tolerance);
    };
    std::vector<double> sums{0.};
    for(std::size_t i = 1; i < edges.size(); ++i)
      sums.push_back(sums.back() + over(edges[i - 1], edges[i]));
    return [=](double time)
    {
      const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, time);
      const auto panel = static_cast<std::size_t>(above - edges.begin()) - 1;
      return sums[panel] + over(edges[panel], time);
    };
  }
} // namespace meltfront::cases
