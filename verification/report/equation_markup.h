#ifndef meltfront_verification_report_equation_markup_h
#define meltfront_verification_report_equation_markup_h

#include <verification/report/markup.h>

#include <string>

namespace meltfront::verification
{
  /** An italic letter with an index. */
  Markup symbol(const std::string &name, const std::string &index = "");

  Markup fraction(const Markup &above, const Markup &below);

  /** dT/dx and the like, with round d's. */
  Markup derivative(const Markup &of, const Markup &by);

  /** A number of four digits. */
  Markup equation_number(double value);

  /** A number before a symbol; one is left out. */
  Markup factor(double value);

  /** An equation once more with numbers in it. */
  Markup filled(const Markup &equation);

  /** An equation on a line of its own, with a word on what it holds for. */
  Markup equation_line(const std::string &where, const Markup &equation);
} // namespace meltfront::verification

#endif
