#ifndef meltfront_cases_case_file_value_units_h
#define meltfront_cases_case_file_value_units_h

#include <string>

namespace meltfront::cases
{
  /** A value without its units, and one of those that it had. */
  struct PlainValue
  {
    std::string text; ///< numbers in SI units
    std::string unit; ///< the last that was named; empty: none
  };

  /**
   * A number, or several separated by commas, each of which may have a unit behind it:
   * `10 cm, 0.2`. The number is put into SI units. Parts that are no number with a known
   * unit behind it stay as they are: expressions, tables, words.
   */
  PlainValue without_units(const std::string &text);

  /**
   * The same where the value's unit is known.
   *
   * @param unit of the key, or several: `W or W/m`; degrees Celsius and kelvin are the
   * scales of one unit here, for a scene holds temperatures on the one that it likes
   * @throws InputError, a clause that follows the key's name, for a unit of another kind
   * and for one that is unknown behind a number; both name those that would be right
   */
  PlainValue in_units_of(const std::string &text, const std::string &unit);

  /** Whether a text is one number with a known unit behind it. */
  bool is_number_with_unit(const std::string &text);

  /** Whether a unit is one of the scales of temperature. */
  bool is_temperature_scale(const std::string &unit);
} // namespace meltfront::cases

#endif
