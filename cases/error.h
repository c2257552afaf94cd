#ifndef meltfront_cases_error_h
#define meltfront_cases_error_h

#include <stdexcept>
#include <string>

namespace meltfront::cases
{
  /**
   * Bad arguments or a bad case file. The message is one sentence that says what is
   * wrong, where (file, line, key) and what would be right. Exit status 2.
   */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A method declines a scene or an option value that it cannot treat correctly: an
   * effect it lacks, a dimension it does not support, a time step beyond its stability
   * limit. Shown as `n/a` or `refused` with the reason, never as a result.
   */
  class Refusal : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A run failed numerically: a value that is not finite, a broken bound, a solver that
   * does not converge. Exit status 3.
   */
  class NumericalError : public std::runtime_error
  {
  public:
    /** Compose the sentence "METHOD, step STEP, t = TIME: QUANTITY PROBLEM". */
    NumericalError(const std::string &method, long step, double time,
                   const std::string &quantity, const std::string &problem);

    std::string method;
    long step;
    double time;
    std::string quantity;
  };

  /** A file cannot be read or written. Exit status 4. */
  class OutputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace meltfront::cases

#endif
