#ifndef meltfront_verification_app_command_descriptions_h
#define meltfront_verification_app_command_descriptions_h

#include <verification/app/manual/command_description.h>

#include <CLI/CLI.hpp>

#include <vector>

namespace meltfront::verification
{
  /** Put an example below the help of every command. @throws std::logic_error for a
   * command that has none */
  void add_examples(CLI::App &app);

  /** The commands of a command line, in its order. */
  std::vector<CommandDescription> descriptions_of(const CLI::App &app);
} // namespace meltfront::verification

#endif
