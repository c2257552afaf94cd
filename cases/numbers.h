#ifndef meltfront_cases_numbers_h
#define meltfront_cases_numbers_h

#include <limits>

namespace meltfront::cases
{
  inline constexpr double infinity = std::numeric_limits<double>::infinity();

  /** What stands where a quantity is not defined. */
  inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
} // namespace meltfront::cases

#endif
