#ifndef meltfront_verification_judge_coverage_h
#define meltfront_verification_judge_coverage_h

#include <verification/judge/ladder.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** How often the true error lies within the error bar. */
  struct Coverage
  {
    std::string method;
    std::string quantity;   ///< `front`, `front over time`, `solid_volume`, `temperature`
    int levels = 0;         ///< from so many the bars were made, 2 or 3
    int instances = 0;      ///< cases, labels and finest levels with a bar
    int not_converging = 0; ///< beside these: where there was no bar
    int covered = 0;        ///< instances whose true error is at most the bar
    double median_bar_over_error = cases::nan;

    double share() const
    {
      return instances > 0 ? static_cast<double>(covered) / instances : cases::nan;
    }
  };

  /**
   * Hold the bars of every ladder against the exact solution, where there is one: each
   * ladder of m levels tells of m - 1 bars, one for each finest level. True errors below
   * 1e-12 of the quantity's size count as that; where the exact solution holds only
   * approximately, a front is covered up to the solution's floor beyond the bar, and
   * other quantities, of which no floor is known, are left out. Sorted by method and
   * quantity.
   */
  std::vector<Coverage> coverage_of(const MatrixResult &result);

  /** `method,quantity,levels,covered,median_bar_over_error,instances,not_converging`;
   * `covered` is a share. */
  std::string coverage_csv(const std::vector<Coverage> &coverage);
} // namespace meltfront::verification

#endif
