#ifndef meltfront_verification_matrix_time_estimate_h
#define meltfront_verification_matrix_time_estimate_h

#include <map>
#include <string>

namespace meltfront::verification
{
  /** What tells how long a run takes. */
  struct RunKind
  {
    std::string case_name;
    std::string label;
    std::string method;
    int n = 1;
  };

  /** Guesses how long runs take from those that have ended. */
  class TimeEstimate
  {
  public:
    void add(const RunKind &run, double seconds);

    /** What a run took another time, on whatever machine. */
    void expect(const RunKind &run, double seconds);

    /**
     * Of a run that took a known time once: that time, as many times as those that have
     * ended took theirs. Else from runs of the same case and label: a power of n through
     * the two whose n are nearest; through one, the square of n. Else from those of the
     * same method, else from all: the mean of their times, each scaled by the square of
     * n.
     *
     * @return s; NaN as long as no run has ended
     */
    double seconds(const RunKind &run) const;

  private:
    using TimesByN = std::map<int, double>;

    /** Times of runs, each scaled to n = 1. */
    struct Mean
    {
      double sum = 0;
      int count = 0;
    };

    std::map<std::pair<std::string, std::string>, TimesByN> series, expected;
    double expected_of_ended = 0, taken_by_these = 0; ///< s, of runs that were expected
    std::map<std::string, Mean> methods;
    Mean all;
  };
} // namespace meltfront::verification

#endif
