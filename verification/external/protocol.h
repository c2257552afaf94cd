#ifndef meltfront_verification_external_protocol_h
#define meltfront_verification_external_protocol_h

#include <nlohmann/json_fwd.hpp>

#include <stdexcept>
#include <string>

namespace meltfront::verification::external
{
  /** Its number: what a manifest, a request and an answer begin with. */
  inline constexpr int protocol = 1;

  /** A program did not answer, or not as it should: the run has failed. One sentence. */
  class ProgramError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** Path of a file in this folder: the schema, `examples/NAME.json`. */
  std::string folder_path(const std::string &name);

  /**
   * What is wrong with a message by protocol.schema.json, one clause that follows the
   * message's name: `/effects/0, "phase", ...`; empty for nothing.
   * @param definition `manifest`, `request`, `start`, `snapshot`, `end` or `refused`
   */
  std::string breach_of_protocol(const nlohmann::json &message,
                                 const std::string &definition);

  /** A text as it can stand in a sentence: one line, printable, not too long. */
  std::string quoted(std::string text);
} // namespace meltfront::verification::external

#endif
