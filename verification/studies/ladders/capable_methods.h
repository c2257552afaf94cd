#ifndef meltfront_verification_studies_ladders_capable_methods_h
#define meltfront_verification_studies_ladders_capable_methods_h

#include <cases/case.h>
#include <cases/method.h>

#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Values of options that a user gives, by method and key; of all others the defaults.
   */
  using MethodSettings = std::map<std::string, std::map<std::string, std::string>>;

  /** The options of a method with the values that are its own.
   * @throws InputError as Options::set() */
  cases::Options options_with(const MethodSettings &settings,
                              const cases::Method &method);

  /** Which of some methods take a case, and why the others do not. */
  struct CapableMethods
  {
    std::vector<const cases::Method *> capable;
    /** One sentence for each reason, with the methods that it keeps out. */
    std::vector<std::string> left_out;
  };

  /** Ask the capabilities of every method; nothing is run. */
  CapableMethods capable_methods(const cases::Case &c,
                                 const std::vector<const cases::Method *> &all,
                                 const MethodSettings &settings = {});
} // namespace meltfront::verification

#endif
