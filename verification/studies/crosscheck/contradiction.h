#ifndef meltfront_verification_studies_crosscheck_contradiction_h
#define meltfront_verification_studies_crosscheck_contradiction_h

#include <cases/material.h>
#include <verification/studies/crosscheck/error_bar.h>
#include <verification/studies/crosscheck/level_runs.h>

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

  /** A quantity of a scene of which methods say what cannot be true of both. */
  struct Contradiction
  {
    std::string quantity;
    double time_share = 0; ///< when: share of the duration
    double scale = 1;      ///< of the quantity
    std::vector<Statement> statements;
    std::vector<std::string> suspects; ///< methods that contradict the others
    double excess = 0; ///< largest difference from another over both bars together
  };

  /**
   * The contradiction of largest excess among the finished runs of a scene, of all
   * quantities at quarters of the duration; nothing where none contradicts another.
   *
   * Temperatures are taken relative to the span of all temperatures found, heat to that
   * of the warmest and the coldest state, solid fractions to one.
   */
  std::optional<Contradiction> worst_contradiction(const std::vector<LevelRun> &runs,
                                                   const cases::Material &material);
} // namespace meltfront::verification

#endif
