#ifndef meltfront_verification_fuzz_trials_h
#define meltfront_verification_fuzz_trials_h

#include <functional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A kind of file that the program reads. */
  struct FileKind
  {
    std::string name;
    std::vector<std::string> originals; ///< texts that are in order
    /** Reads a text; may throw what the program answers with one sentence. */
    std::function<void(const std::string &text)> read;
  };

  /** A mutated text that was read as none should be. */
  struct Offence
  {
    std::string kind, what, text;
    unsigned long seed = 0;
  };

  /**
   * Read `count` mutated texts of a kind, each in at most `seconds` of CPU time, in
   * processes of their own. An offence is any end but a value or an exception of the
   * program's own (cases/error.h): a crash, another exception, one without a message, a
   * reader that does not come back or takes more than 4 GB.
   */
  std::vector<Offence> offences(const FileKind &kind, unsigned long first_seed,
                                unsigned long count, int seconds = 20);
} // namespace meltfront::verification

#endif
