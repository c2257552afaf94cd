#ifndef meltfront_verification_app_manual_man_page_h
#define meltfront_verification_app_manual_man_page_h

#include <verification/app/manual/command_description.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** The commands as a page for `man`, section 1. */
  std::string man_page(const std::vector<CommandDescription> &commands);

  /** What bash completes: commands, their options, and the names of cases, methods and
   * matrices as they are now. To be read by `source`. */
  std::string bash_completion(const std::vector<CommandDescription> &commands);
} // namespace meltfront::verification

#endif
