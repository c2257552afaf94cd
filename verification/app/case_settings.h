#ifndef meltfront_verification_app_case_settings_h
#define meltfront_verification_app_case_settings_h

#include <functional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What a command sets, told apart by what is left of the equals sign: a method's
   * option has a dot there, METHOD.KEY, a case file's key none. */
  struct Settings
  {
    std::vector<std::string> of_method; ///< METHOD.KEY=VALUE
    std::vector<std::string> of_case;   ///< SUBSECTION/KEY=VALUE
  };

  /** @throws cases::InputError for one that has no equals sign */
  Settings sort_settings(const std::vector<std::string> &settings);

  /** The settings of a command that chooses the methods' options itself.
   * @throws cases::InputError if one is a method's */
  std::vector<std::string> settings_of_case(const std::vector<std::string> &settings);

  /**
   * A case with other values of some keys (cases::vary_case), written to a file of its
   * own, without the acceptance criteria, whose figures are those of the case as it
   * stands. Its name is the case's with what was set,
   * `pipe-freezing-Material-latent-heat-3e5`.
   *
   * @param directory_of gives the directory of what the command writes, by the case's
   * name; the file goes there
   * @return the file's path; the case's own name where nothing is set
   * @throws cases::InputError for keys and values that do not suit the case
   * @throws cases::OutputError if the file cannot be written
   */
  std::string
  varied_case(const std::string &case_name, const std::vector<std::string> &settings,
              const std::function<std::string(const std::string &)> &directory_of);
} // namespace meltfront::verification

#endif
