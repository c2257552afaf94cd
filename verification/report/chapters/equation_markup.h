#ifndef meltfront_verification_report_chapters_equation_markup_h
#define meltfront_verification_report_chapters_equation_markup_h

#include <verification/report/page/markup.h>

#include <string>
#include <string_view>
#include <vector>

namespace meltfront::verification
{
  /**
   * An equation from a pattern: `$x`, `$x_s`, `$x_{k+1}` is an italic letter with an
   * index, `^{2}` a power, `\f{A}{B}` a fraction, `\d{A}{B}` the derivative of A by B
   * with round d's, `#` the next of the arguments; all else is plain text.
   */
  Markup math(std::string_view pattern, const std::vector<Markup> &arguments = {});

  /** The same with numbers in place of its letters, below it. */
  Markup filled(const Markup &equation);

  /** A number of four digits. */
  Markup equation_number(double value);

  /** A number before a symbol; one is left out. */
  Markup factor(double value);

  /** An equation on a line of its own, with a word on what it holds for. */
  Markup equation_line(const std::string &where, const Markup &equation);

  /** A condition beside its name, in a list of such. */
  Markup condition(const std::string &what, const Markup &words);
} // namespace meltfront::verification

#endif
