#ifndef meltfront_verification_judge_median_course_h
#define meltfront_verification_judge_median_course_h

#include <verification/judge/matrix_result.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * What other methods say of a case without an exact solution: the course of the solid's
   * volume. Every method speaks with its finest finished run, whatever its options; the
   * answer is their median, at 50 times.
   */
  class MedianCourse
  {
  public:
    /** @param runs of one case */
    explicit MedianCourse(const std::vector<const RunRecord *> &runs);

    /** Methods that a run of one can be held against. */
    int others(const std::string &method) const;

    /** Root mean square over time of the solid's volume less the other methods' median
     * (m, m^2, m^3); NaN where there is no other method. */
    double distance(const RunRecord &run) const;

    /** The largest less the least volume of the median of all methods. */
    double course() const;

  private:
    struct Voice
    {
      std::string method;
      std::vector<double> volume; ///< at the times
    };

    std::vector<double> median_without(const std::string &method) const;

    std::vector<double> times;
    std::vector<Voice> voices;
  };
} // namespace meltfront::verification

#endif
