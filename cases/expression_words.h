#ifndef meltfront_cases_expression_words_h
#define meltfront_cases_expression_words_h

#include <string>
#include <vector>

namespace meltfront::cases
{
  /** The functions that expressions may call. */
  const std::vector<std::string> &expression_functions();

  /** The names in an expression, of variables, constants and functions, in their order.
   */
  std::vector<std::string> names_in(const std::string &expression);

  /** The numbers written in an expression, without signs, in their order. */
  std::vector<double> numbers_in(const std::string &expression);

  /** Whether a value is a table, points `a: b, c: d`, and no expression. */
  bool is_table(const std::string &value);

  /**
   * Whether what an expression says may depend on one of some variables, each a letter.
   * Words that are no expression (`exact`) say nothing: what they stand for may depend on
   * any.
   */
  bool may_depend_on(const std::string &expression, const std::string &variables);

  /** Whether what an expression says may jump where one of some variables changes: as one
   * that compares them does, or rounds them or takes their sign. */
  bool may_jump_with(const std::string &expression, const std::string &variables);
} // namespace meltfront::cases

#endif
