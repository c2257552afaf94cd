#ifndef meltfront_verification_app_list_h
#define meltfront_verification_app_list_h

#include <string>

namespace meltfront::verification
{
  /**
   * What there is, printed from the declarations themselves.
   * @param what cases, methods, effects, matrices, or empty for all four; quantities:
   * what is measured; keys: those of case files; capabilities: what each method takes
   */
  std::string list_text(const std::string &what);
} // namespace meltfront::verification

#endif
