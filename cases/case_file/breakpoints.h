#ifndef meltfront_cases_case_file_breakpoints_h
#define meltfront_cases_case_file_breakpoints_h

#include <cases/scene.h>

#include <functional>
#include <string>
#include <vector>

namespace meltfront::cases
{
  /**
   * The numbers that an expression names, and those that sums, differences, products and
   * quotients of two or three of them make, within a span of time: where it may jump or
   * bend, as in abs(t/60 - 5) < 0.1.
   */
  std::vector<double> named_times(const std::string &expression, double start,
                                  double end);

  /**
   * Times between start and end at which a function jumps, bends, or varies so briefly
   * that samples of the whole may pass it by; ascending.
   *
   * The span is cut at equal distances and at the candidates. On each piece a polynomial
   * of degree 4 through five points is held against the function at four others: where
   * they disagree the worse half is followed, to round-off if the function jumps or bends
   * there (the disagreement then falls no faster than the length), else to the length at
   * which it is smooth. A function that hardly any piece resolves is cut finer.
   *
   * @throws InputError with the reason alone, if the function is not finite or varies too
   * fast for the finest cuts
   */
  std::vector<double> find_breakpoints(const std::function<double(double)> &function,
                                       const std::vector<double> &candidates,
                                       double start, double end);

  /** Fill in Field::breakpoints of an expression: those at some positions.
   * @throws InputError as find_breakpoints() */
  void add_breakpoints(Field &field, const std::vector<Position> &positions, double start,
                       double end);
} // namespace meltfront::cases

#endif
