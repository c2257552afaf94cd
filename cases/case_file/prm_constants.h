#ifndef meltfront_cases_case_file_prm_constants_h
#define meltfront_cases_case_file_prm_constants_h

#include <map>
#include <set>
#include <string>
#include <vector>

namespace meltfront::cases
{
  /** A value in which no constant is named any more. */
  struct PlainFormula
  {
    std::string text;
    std::vector<std::string> units; ///< that constants within formulas were given in
  };

  /**
   * Names that a parameter file gives to numbers: `r = 5 cm`, `area = pi*r^2`. Values of
   * keys name them.
   *
   * A constant that is all of a value, or all of what stands between two of its commas,
   * is replaced by what it was given as, with its unit, which is then held against the
   * key's as if it stood there. Within a formula it is replaced by its number in SI
   * units, in brackets. What is thrown are clauses that follow the key's name.
   */
  class PrmConstants
  {
  public:
    /**
     * @param value a number, also one with a unit, or a formula of constants that were
     * set before
     * @throws InputError for a name that is a variable's or a function's or no name, a
     * formula that cannot be parsed, and a value that is not finite
     */
    void set(const std::string &name, const std::string &value);

    /** A list of numbers: formulas of constants become numbers.
     * @throws InputError for a formula that cannot be parsed */
    PlainFormula in_numbers(const std::string &value);

    /** An expression, or several separated by commas. */
    PlainFormula in_expressions(const std::string &value);

    /** Names that no value has named, sorted. */
    std::vector<std::string> unused() const;

  private:
    struct Constant
    {
      std::string given; ///< with its unit
      std::string unit;  ///< empty: none
      double number = 0; ///< in SI units
    };

    bool named_in(const std::string &formula) const;
    PlainFormula replaced(const std::string &formula);

    std::map<std::string, Constant> constants;
    std::set<std::string> used;
  };
} // namespace meltfront::cases

#endif
