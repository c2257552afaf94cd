#ifndef meltfront_verification_studies_crosscheck_random_course_h
#define meltfront_verification_studies_crosscheck_random_course_h

#include <verification/studies/crosscheck/random_stream.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A value over time, as an expression of t, and simpler ones that say less. */
  struct Course
  {
    std::string expression;
    std::vector<std::string> simpler;
  };

  /**
   * From one value towards another over a duration: constant at either, a ramp, a ramp
   * that is held, a pulse, a wave, a switch.
   * @param varied probability that it is not constant
   */
  Course random_course(RandomStream &random, double from, double to, double duration,
                       double varied);
} // namespace meltfront::verification

#endif
