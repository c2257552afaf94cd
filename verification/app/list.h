#ifndef meltfront_verification_app_list_h
#define meltfront_verification_app_list_h

#include <cases/options.h>

#include <string>

namespace meltfront::verification
{
  /**
   * What there is, printed from the declarations themselves.
   * @param what cases, methods, effects, matrices, or empty for all four; quantities:
   * what is measured; keys: those of case files; capabilities: what each method takes
   */
  std::string list_text(const std::string &what);

  /** An option's default with its unit, and what it may be: `0.8, 0 to 1`. */
  std::string value_text(const cases::OptionDeclaration &option);
} // namespace meltfront::verification

#endif
