#ifndef meltfront_verification_studies_ladders_capable_methods_h
#define meltfront_verification_studies_ladders_capable_methods_h

#include <cases/case.h>
#include <cases/method.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Which of some methods take a case, and why the others do not. */
  struct CapableMethods
  {
    std::vector<const cases::Method *> capable;
    /** One sentence for each reason, with the methods that it keeps out. */
    std::vector<std::string> left_out;
  };

  /** Ask the capabilities of every method; nothing is run. */
  CapableMethods capable_methods(const cases::Case &c,
                                 const std::vector<const cases::Method *> &all);
} // namespace meltfront::verification

#endif
