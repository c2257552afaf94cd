#ifndef meltfront_verification_judge_answers_h
#define meltfront_verification_judge_answers_h

#include <verification/judge/consensus.h>
#include <verification/judge/ladder.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What one label answers. */
  struct MethodAnswer
  {
    std::string label, method;
    int n = 0;         ///< of its finest finished run
    int dimension = 1; ///< in which that ran
    ErrorBar bar;
    double cpu_seconds = 0;               ///< of that run
    double error = cases::nan;            ///< true error; NaN where that is unknown
    double distance_in_bars = cases::nan; ///< from the consensus; above 1: contradicts it
  };

  /** What all labels of a case answer to one question. */
  struct Answer
  {
    std::string quantity;
    std::string unit;          ///< empty in a case of normalised quantities
    double exact = cases::nan; ///< NaN where it is unknown
    double scale = cases::nan; ///< size of the quantity, of temperatures their range
    Consensus consensus;
    std::vector<MethodAnswer> methods;
  };

  /** Every quantity (bars_of()) of a case that some label answers; the course of the
   * front is no answer. Of several seeds the one with the largest bar stands for all, its
   * bar widened by half the spread of the values. */
  std::vector<Answer> answers_of(const MatrixResult &result, const StoredCase &record);

  /** `[{quantity, consensus, bar, agreed, methods: [{method, n, value, bar, cpu_seconds,
   * ...}]}]` */
  nlohmann::json answers_json(const std::vector<Answer> &answers);

  /** A level of a label with the error that its course has by the best that is known. */
  struct LevelError
  {
    std::string label;
    int n = 0;
    int dimension = 1;
    double error = cases::nan; ///< relative to the quantity's size at the end
    double cpu_seconds = 0;
    std::string quantity{}; ///< of which: `front` or `solid volume`
  };

  /**
   * The error of every level: the root mean square over time of its distance from the
   * finest run of the label with the smallest bar among those that agree with the
   * consensus, plus the bar of its course; from the exact solution where there is one (of
   * a run with too few times for a mean the largest distance). Of the front where it is
   * at one coordinate, else of the solid's volume. Empty where no label has a bar, or
   * none agree and there is no exact solution.
   */
  std::vector<LevelError> level_errors(const MatrixResult &result,
                                       const StoredCase &record);

  /** Relative errors of which the cheapest method is told. */
  inline constexpr double errors_of_interest[]
      = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};

  /** The cheapest level whose error is at most the wanted one; null if there is none. */
  const LevelError *cheapest_level(const std::vector<LevelError> &levels, double wanted);
} // namespace meltfront::verification

#endif
