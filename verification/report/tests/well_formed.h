#ifndef meltfront_verification_report_tests_well_formed_h
#define meltfront_verification_report_tests_well_formed_h

#include <string>

namespace meltfront::verification::fixture
{
  /**
   * The first place where a page is not well-formed, or nothing: every tag is closed in
   * the order of opening, attributes are quoted and stand once, no bare `<` or `&`.
   */
  std::string first_mistake(const std::string &page);
} // namespace meltfront::verification::fixture

#endif
