#ifndef meltfront_verification_studies_crosscheck_contradiction_h
#define meltfront_verification_studies_crosscheck_contradiction_h

#include <cases/material.h>
#include <verification/studies/crosscheck/estimate.h>
#include <verification/studies/crosscheck/level_runs.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What one method says of a quantity. */
  struct Statement
  {
    std::string method;
    Estimate estimate;
  };

  /**
   * Who contradicts the others. Two agree if their values differ by no more than their
   * bars together. The leader is who agrees with most (of several the one with the
   * smallest bar), the consensus the smallest bar among those that agree with the leader;
   * who disagrees with it is returned. Where nobody agrees with anybody, or as many agree
   * with one as with another that contradicts it, all are.
   *
   * @return positions in the list, ascending
   */
  std::vector<std::size_t> contradicting(const std::vector<Statement> &statements);

  /** What methods say of a quantity of a scene at a time. */
  struct Comparison
  {
    std::string quantity;
    double time_share = 0; ///< share of the duration
    double scale = 1;      ///< of the quantity
    std::vector<Statement> statements{};
  };

  /** A comparison in which not all can be right. */
  struct Contradiction : Comparison
  {
    std::vector<std::string> suspects{}; ///< methods that contradict the others
    double excess = 0; ///< largest difference from another over both bars together
  };

  /**
   * All that two methods or more say of the same in their finished runs, at quarters of
   * the duration. Temperatures have the scale of the span of all temperatures found, heat
   * that between the coldest solid and the warmest liquid, solid fractions one.
   */
  std::vector<Comparison> comparisons(const std::vector<LevelRun> &runs,
                                      const cases::Material &material);

  /** The contradiction of largest excess; nothing where none contradicts another. */
  std::optional<Contradiction>
  worst_contradiction(const std::vector<Comparison> &comparisons);

  /** The largest difference of two statements of one quantity, over both bars together;
   * 0 where nothing is compared. */
  double largest_excess(const std::vector<Comparison> &comparisons);

  /** By method, the median of its bars over their scales: what a contradiction must
   * exceed to be seen. */
  std::map<std::string, double> relative_bars(const std::vector<Comparison> &comparisons);
} // namespace meltfront::verification

#endif
