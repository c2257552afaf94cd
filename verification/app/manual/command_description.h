#ifndef meltfront_verification_app_manual_command_description_h
#define meltfront_verification_app_manual_command_description_h

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** An option of a command, or a word that it takes. */
  struct CommandOption
  {
    std::string name; ///< `--out`, or of a word its name
    std::string description;
    bool is_word = false; ///< stands by itself, without a name before it
    bool takes_value = false;
    bool required = false;
    std::vector<std::string> choices{}; ///< of the value; empty: any
  };

  /** A command, as the program declares it. */
  struct CommandDescription
  {
    std::string name;
    std::string description;
    std::vector<std::string> examples; ///< whole lines, with cases::program_call()
    std::vector<CommandOption> options;
  };

  /** `meltfront run CASE --method METHOD [OPTIONS]` */
  std::string usage_of(const CommandDescription &command);
} // namespace meltfront::verification

#endif
