#ifndef meltfront_cases_case_file_expression_h
#define meltfront_cases_case_file_expression_h

#include <cases/scene.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::cases
{
  /**
   * Read an expression of the given variables (some of x, y, z, t) and pi, as deal.II's
   * FunctionParser does. One without variables becomes a Field::uniform. Where t is among
   * the variables a table may stand, points `time: value, time: value` in seconds: linear
   * between them, and its times are the field's breakpoints; add_breakpoints() refuses a
   * run that goes beyond.
   *
   * @throws InputError with the reason alone (the caller knows file, line and key): a
   * name that is unknown (with the nearest one), a formula that cannot be parsed, a
   * constant that is not finite.
   */
  Field parse_field(const std::string &expression, const std::string &variables);

  /**
   * Read an expression of one variable and pi; may be evaluated by several threads at
   * once. @throws InputError as parse_field() does
   */
  std::function<double(double)> parse_function(const std::string &expression,
                                               const std::string &variable);

  /**
   * Read the points of a table, `a: b, c: d`.
   * @param form what a point is, for complaints: `temperature: value`
   * @throws InputError with the reason alone
   */
  std::vector<std::pair<double, double>> parse_points(const std::string &text,
                                                      const std::string &form);

  /**
   * Integral of a function of time from `start`, for times up to `end`: Gauss-Kronrod
   * quadrature over 64 panels, which breakpoints (ascending) divide further, and whose
   * sums are kept, so that differences of two results are those of one and the same
   * function.
   */
  std::function<double(double time)>
  integral_from(std::function<double(double time)> function, double start, double end,
                const std::vector<double> &breakpoints = {});
} // namespace meltfront::cases

#endif
