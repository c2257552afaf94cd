#ifndef meltfront_verification_fuzz_mutation_h
#define meltfront_verification_fuzz_mutation_h

#include <random>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * What becomes of a text at the hands of a careless or hostile writer: one to six of
   * these, at random: a bit flipped; bytes taken out, repeated or cut off; a line moved
   * or taken from another text; a number replaced by a hostile one; a hostile word put
   * in. The same generator state gives the same text.
   */
  std::string mutated(const std::string &text, const std::vector<std::string> &others,
                      std::mt19937_64 &random);
} // namespace meltfront::verification

#endif
