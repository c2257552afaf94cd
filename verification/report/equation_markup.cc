#include <verification/report/equation_markup.h>
#include <verification/report/table.h>

namespace meltfront::verification
{
  Markup symbol(const std::string &name, const std::string &index)
  {
    Markup result = element("i", name);
    if(!index.empty())
      result += element("sub", index);
    return result;
  }

  Markup fraction(const Markup &above, const Markup &below)
  {
    return element("span", {{"class", "fraction"}},
                   element("span", above) + element("span", below));
  }

  Markup derivative(const Markup &of, const Markup &by)
  {
    return fraction(text("∂") + of, text("∂") + by);
  }

  Markup equation_number(double value)
  {
    return number_markup(value, 4);
  }

  Markup factor(double value)
  {
    return value == 1 ? Markup() : equation_number(value) + text(" ");
  }

  Markup filled(const Markup &equation)
  {
    return element("span", {{"class", "filled"}}, equation);
  }

  Markup equation_line(const std::string &where, const Markup &equation)
  {
    return element("div", {{"class", "equation"}},
                   element("span", {{"class", "where"}}, text(where))
                       + element("span", equation))
           + Markup("\n");
  }
} // namespace meltfront::verification
