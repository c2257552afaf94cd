#ifndef meltfront_verification_judge_consensus_h
#define meltfront_verification_judge_consensus_h

#include <cases/numbers.h>

#include <span>
#include <vector>

namespace meltfront::verification
{
  /** A value that a method answers. */
  struct AnswerInterval
  {
    double value;
    double bar;      ///< half width
    bool converging; ///< false: takes no part
  };

  /** What several answers to one question say together. */
  struct Consensus
  {
    double value = cases::nan;
    double bar = cases::nan;
    /** Two answers agree at least. False: the value and bar are the middle and half the
     * width of what the answers cover, and none is confirmed. */
    bool agreed = false;
    int support = 0;     ///< answers that agree with it
    int taking_part = 0; ///< answers that converge, with a bar
    /** For each answer, its distance from the consensus over the sum of both bars: above
     * 1 it contradicts the consensus. NaN for one that took no part. */
    std::vector<double> distance_in_bars;

    /** Answers with bars that exclude each other, so that none is confirmed. */
    bool contradictory() const
    {
      return !agreed && taking_part > 1;
    }
  };

  /**
   * The smallest bar among the largest group of answers that agree.
   *
   * Two answers agree if |f_i - f_j| <= bar_i + bar_j. The leader is the one with which
   * most agree (of equals the one of the smallest bar); the consensus is the value and
   * the bar of the smallest bar among those that agree with it. Where no two agree, or a
   * second leader of equal support contradicts the first, there is none. Errors of
   * methods are biases: a mean weighted by the inverse squares of the bars would have a
   * bar that shrinks while the biases do not. A bias that all share stays unseen.
   */
  Consensus consensus_of(std::span<const AnswerInterval> answers);
} // namespace meltfront::verification

#endif
