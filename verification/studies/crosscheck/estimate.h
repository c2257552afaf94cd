#ifndef meltfront_verification_studies_crosscheck_estimate_h
#define meltfront_verification_studies_crosscheck_estimate_h

#include <cstddef>
#include <vector>

namespace meltfront::verification
{
  /** A quantity over the times of a course, at one resolution. */
  struct CourseLevel
  {
    double spacing = 0; ///< h (m)
    std::vector<double> values;
    std::vector<double> misreadings{}; ///< by how much each may be misread; empty: not
  };

  /** A value with what is known of its error. */
  struct Estimate
  {
    double value = 0;
    double bar = 0;         ///< half width; infinite of a single level
    double order = 0;       ///< with which the bar was computed; 0: none
    bool converging = true; ///< differences between levels shrink
  };

  /** Order beyond which none is believed: where a front crosses cells, or a step is cut
   * short, differences of three levels show a higher one by chance. */
  inline constexpr double highest_order = 1;

  /** The order of two levels, which show none. */
  inline constexpr double order_of_two_levels = 0.5;

  /** By how much a bar exceeds Richardson's estimate of the error: Roache's (1994) factor
   * for two grids. Chosen on seeds 31415, 23426 and 990017: with a factor 2 and orders up
   * to 2 four of 140 scenes, with 3 and 2 four of 225 were suspect, by 1.1 to 2.1 bars,
   * of honest errors that fall irregularly. */
  inline constexpr double safety_factor = 3;

  /** Least bar, relative to the scale of the quantity: what reading a state by sums over
   * sites and interpolating between steps may be off by. */
  inline constexpr double reading_error = 3e-4;

  /**
   * The value of the finest level at one of the course's times, and its error bar.
   *
   * error_bar() of all pairs of neighbours among the finest four levels, with
   * safety_factor and orders up to highest_order, whatever the method: random scenes are
   * rougher than those on which the constants of methods were chosen. Its time norm is
   * the root mean square over the whole course, for the width over a quarter of it around
   * the time. Added to it is a floor, reading_error times the scale and what the finest
   * level may be misread by. Steps are refined with space (scene_check), so that
   * differences hold the error of both.
   *
   * Levels should not double: a front that rests at x stands in its cell at the fraction
   * of n x, and doubling n leaves its distance from the cell's middle as it was.
   *
   * @param coarse_to_fine at least one, of the same times; only the finest four count
   * @param scale of the quantity
   */
  Estimate estimate_at(const std::vector<CourseLevel> &coarse_to_fine, std::size_t time,
                       double scale);
} // namespace meltfront::verification

#endif
