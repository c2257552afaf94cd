#ifndef meltfront_verification_external_manifest_h
#define meltfront_verification_external_manifest_h

#include <cases/capabilities.h>
#include <cases/options.h>
#include <verification/external/scene_json.h>

#include <string>
#include <vector>

namespace meltfront::verification::external
{
  /** What a program says of itself. */
  struct Manifest
  {
    std::string name;
    std::string folder; ///< in which its file is
    std::string text;   ///< of its file
    std::vector<std::string> command;
    /** Commands that have to succeed, or the program is left out on this machine. */
    std::vector<std::vector<std::string>> requirements;
    cases::Capabilities capabilities;
    std::vector<cases::OptionDeclaration> options; ///< the program's own
    Sampling sampling;
  };

  /** The file that a user names: by its path, or by its name among the examples and the
   * benchmarks.
   * @throws cases::InputError if there is no such name */
  std::string manifest_path(const std::string &name_or_path);

  /** @throws cases::InputError if it cannot be read or is not as the schema says. */
  Manifest read_manifest(const std::string &path);
} // namespace meltfront::verification::external

#endif
