#ifndef meltfront_verification_report_page_number_text_h
#define meltfront_verification_report_page_number_text_h

#include <verification/report/page/markup.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A number as decimal digits and, in scientific notation, a power of ten. */
  struct NumberText
  {
    std::string digits;   ///< `1.35`, `0.0123`, `-4`; empty for NaN
    std::string exponent; ///< `-3`; empty for a plain number

    /** `1.35e-3`, `0.0123`, `n/a` for NaN. */
    std::string plain() const;

    /** The same with a superscript exponent: 1.35 x 10^-3. */
    Markup markup() const;

    /** The same in TeX's mathematics, without dollar signs. */
    std::string tex() const;
  };

  /** Which notation the numbers of a column share. */
  enum class Notation
  {
    automatic, ///< plain between 0.01 and 10 000, scientific otherwise
    plain,
    scientific
  };

  /** A value in so many significant digits; digits before the decimal point are never
   * rounded away. */
  NumberText number_text(double value, int significant_digits = 3,
                         Notation notation = Notation::automatic);

  /** Digits with a minus sign instead of a hyphen. */
  std::string with_minus_sign(const std::string &digits);

  /** A whole number, in groups of three digits from 10 000 on (thin spaces). */
  std::string grouped(long value);

  /** The notation that suits all finite values of a column. */
  Notation column_notation(const std::vector<double> &values);

  /** A number of running text: plain between 0.001 and a million, without zeros at the
   * end. */
  NumberText prose_number(double value, int significant_digits = 3);

  /** The same as plain text and as markup. */
  std::string plain_number(double value, int significant_digits = 3);
  Markup number_markup(double value, int significant_digits = 3);

  /** A time in the unit that suits it: `35 ms`, `4.1 s`, `2 min 5 s`, `1 h 12 min`. */
  std::string duration_text(double seconds);
} // namespace meltfront::verification

#endif
