#ifndef meltfront_verification_app_crosscheck_command_h
#define meltfront_verification_app_crosscheck_command_h

#include <cstdint>
#include <string>
#include <vector>

namespace meltfront::verification
{
  struct CrosscheckArguments
  {
    int scenes = 20;
    std::uint64_t seed = 1;
    int dimension = 0;                ///< 0: any
    std::string output;               ///< directory; empty: results/crosscheck-SEED
    int jobs = 0;                     ///< runs at once; 0: one per core
    double within = 20;               ///< longest time of a run (s)
    std::vector<std::string> methods; ///< empty: all but those that restate a paper
  };

  /**
   * Random scenes through every method that takes them; prints how many agreed and what
   * did not, and writes it to the directory (verification/studies/crosscheck).
   * @return criterion_failed if any scene is suspect, else all_well
   */
  int crosscheck(const CrosscheckArguments &arguments);
} // namespace meltfront::verification

#endif
