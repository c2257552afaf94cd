#ifndef meltfront_verification_app_manual_manual_h
#define meltfront_verification_app_manual_manual_h

#include <verification/app/manual/command_description.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  struct ManualArguments
  {
    std::string output;          ///< file; empty: results/manual.html, or standard output
    std::string format = "html"; ///< or `man`, `bash`
    std::vector<CommandDescription> commands;
  };

  /**
   * Write the manual: from what the program declares (commands, keys, methods, effects,
   * cases, matrices, quantities), the pages of this folder and of the methods' folders.
   * @throws cases::OutputError if it cannot be written @return an ExitStatus
   */
  int manual(const ManualArguments &arguments);
} // namespace meltfront::verification

#endif
