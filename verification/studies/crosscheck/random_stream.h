#ifndef meltfront_verification_studies_crosscheck_random_stream_h
#define meltfront_verification_studies_crosscheck_random_stream_h

#include <cstdint>
#include <initializer_list>

namespace meltfront::verification
{
  /**
   * Random numbers that are the same on every machine: the splitmix64 generator (Steele,
   * Lea and Flood 2014) of a state that a seed and an index make, and distributions of
   * its own, for those of the standard library are left to each library.
   */
  class RandomStream
  {
  public:
    RandomStream(std::uint64_t seed, std::uint64_t index);

    /** 64 bits. */
    std::uint64_t next();

    /** Between two numbers, in steps of 2^-53 of their distance. */
    double uniform(double lower, double upper);

    /** Between two positive numbers, uniform in the logarithm. */
    double log_uniform(double lower, double upper);

    /** True with a probability. */
    bool chance(double probability);

    /** 0, 1, ..., count - 1. */
    int below(int count);

    /** A number of the list's positions, each with a probability in proportion to its
     * weight. */
    int weighted(std::initializer_list<double> weights);

  private:
    std::uint64_t state;
  };
} // namespace meltfront::verification

#endif
