#ifndef meltfront_cases_case_file_criterion_parser_h
#define meltfront_cases_case_file_criterion_parser_h

#include <cases/case.h>

#include <string>

namespace meltfront::cases
{
  /**
   * Read an acceptance criterion:
   *
   *   METHOD: QUANTITY at n=40 <= 1.755e-3          (or >=)
   *   METHOD: QUANTITY at n=40 in 0.656 .. 0.666
   *   METHOD: QUANTITY at n=20 within 15 % of 0.01063
   *   METHOD: order of QUANTITY >= 1.25             (or <=, in, within)
   *   METHOD: worst QUANTITY <= 1e-12               (or >=, in, within)
   *   METHOD: fails at n=60
   *
   * those of order and worst with `over n=20..50` after the quantity if only some rows
   * count, and each but the last with an optional tail `; expected failure: SENTENCE`.
   * METHOD may be a label with options, `fem-fitted[degree=2,time=bdf3]`, or `any
   * method`.
   *
   * @throws InputError with the reason alone (the caller knows file, line and key).
   */
  Criterion parse_criterion(const std::string &text);

  /**
   * A label without blanks around it: METHOD or METHOD[KEY=VALUE,KEY=VALUE].
   *
   * @throws InputError with the reason alone.
   */
  std::string parse_label(const std::string &text);

  /**
   * Read a printed value, `METHOD: QUANTITY at n=20 = 0.01063 (Table 1)`; what stands in
   * the brackets is appended to the paper that is its source.
   *
   * @throws InputError with the reason alone.
   */
  PrintedValue parse_printed_value(const std::string &text, const std::string &paper);
} // namespace meltfront::cases

#endif
