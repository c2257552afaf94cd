#ifndef meltfront_verification_measure_checks_check_h
#define meltfront_verification_measure_checks_check_h

#include <string>

namespace meltfront::verification
{
  /** What the harness itself asked of a run, at all its snapshots. */
  struct Check
  {
    std::string name; ///< `phase against temperature`, `maximum principle`, ...
    double value = 0; ///< the worst of all snapshots
    double bound = 0; ///< largest value that passes
    bool passed = true;
  };
} // namespace meltfront::verification

#endif
