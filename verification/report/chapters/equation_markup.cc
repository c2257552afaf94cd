#include <verification/report/chapters/equation_markup.h>
#include <verification/report/tables/table.h>

namespace meltfront::verification
{
  namespace
  {
    /** Reads the pattern of an equation. */
    class Pattern
    {
    public:
      Pattern(std::string_view pattern, const std::vector<Markup> &arguments)
        : rest(pattern)
        , arguments(arguments)
      {
      }

      /** Up to the end, or to the brace that closes. */
      Markup read()
      {
        Markup result;
        while(!rest.empty() && rest.front() != '}')
          result += piece();
        return result;
      }

    private:
      Markup piece()
      {
        if(skip("$"))
        {
          Markup result = element("i", character());
          if(skip("_"))
            result += element("sub", skip("{") ? words() : character());
          return result;
        }
        if(skip("^{"))
          return element("sup", words());
        if(skip("\\f{"))
          return fraction("");
        if(skip("\\d{"))
          return fraction("∂");
        if(skip("#"))
          return arguments.at(next++);
        return text(character());
      }

      Markup fraction(const char *before)
      {
        const Markup above = text(before) + read();
        skip("}{");
        const Markup below = text(before) + read();
        skip("}");
        return element("span", {{"class", "fraction"}},
                       element("span", above) + element("span", below));
      }

      std::string words()
      {
        std::string result;
        while(rest.front() != '}')
          result += character();
        rest.remove_prefix(1);
        return result;
      }

      /** One character of UTF-8. */
      std::string character()
      {
        std::size_t size = 1;
        while(size < rest.size() && (rest[size] & 0xC0) == 0x80)
          ++size;
        const std::string result(rest.substr(0, size));
        rest.remove_prefix(size);
        return result;
      }

      bool skip(std::string_view start)
      {
        if(!rest.starts_with(start))
          return false;
        rest.remove_prefix(start.size());
        return true;
      }

      std::string_view rest;
      const std::vector<Markup> &arguments;
      std::size_t next = 0;
    };
  } // namespace

  Markup math(std::string_view pattern, const std::vector<Markup> &arguments)
  {
    return Pattern(pattern, arguments).read();
  }

  Markup filled(const Markup &equation)
  {
    return element("span", {{"class", "filled"}}, equation);
  }

  Markup equation_number(double value)
  {
    return number_markup(value, 4);
  }

  Markup factor(double value)
  {
    return value == 1 ? Markup() : equation_number(value) + text(" ");
  }

  Markup equation_line(const std::string &where, const Markup &equation)
  {
    return element("div", {{"class", "equation"}},
                   element("span", {{"class", "where"}}, text(where))
                       + element("span", equation))
           + Markup("\n");
  }

  Markup condition(const std::string &what, const Markup &words)
  {
    return element("dt", what) + element("dd", words) + Markup("\n");
  }
} // namespace meltfront::verification
