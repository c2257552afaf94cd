#ifndef meltfront_verification_judge_error_bar_h
#define meltfront_verification_judge_error_bar_h

#include <cases/numbers.h>
#include <verification/record/run_record.h>

#include <span>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What is known of a method's errors before it runs; see verification/judge/README.md
   * for the runs on which the factors were chosen. */
  struct BarConstants
  {
    double order_in_space;     ///< highest that is believed, of front, volume and heat
    double order_in_time;      ///< of the time scheme in use
    double factor;             ///< of safety, on front, volume and heat
    double temperature_order;  ///< highest that is believed, of temperatures
    double temperature_factor; ///< of safety, on temperatures
  };

  BarConstants bar_constants(const RunRecord &run);

  /**
   * The order that differences of three levels show (1 the finest): p with D_32/D_21 =
   * r_21^p (r_32^p - 1)/(r_21^p - 1), which rises with p; -1 for none that is positive,
   * 20 at most.
   */
  double observed_order(double difference_ratio, double r21, double r32);

  /** One level of a ladder of resolutions, for one quantity. */
  struct BarLevel
  {
    double spacing; ///< h (m), or dt (s) where the ladder refines time only
    long steps;
    double value;
  };

  /** A value with its error bar. */
  struct ErrorBar
  {
    double value = cases::nan;
    double bar = cases::nan;      ///< half its width, in the unit of the value
    double observed = cases::nan; ///< order; -1 for differences that do not shrink
    double order = cases::nan;    ///< with which the bar was made
    int levels = 0;               ///< that were used
    /** False where differences do not shrink: `bar` is then three times the largest of
     * them, an indication and no bar. */
    bool converging = false;
    std::string remark{};
  };

  /** How the error bar of a quantity is made. */
  struct BarRecipe
  {
    double scale;         ///< S, size of the quantity: its unit of round-off
    double highest_order; ///< p_s
    double order_in_time; ///< q_t
    double factor;        ///< F
    bool in_time = false; ///< the ladder refines time only
    /** Of the two finest levels around the place of a value, where D_21 is over all
     * places: the order is that of all, the width that of the place (of two levels the
     * larger). */
    double local_difference = cases::nan;
  };

  /**
   * The error bar of the finest value of a ladder.
   *
   * From the three finest levels (1 the finest), with d the difference of the two finest
   * values and D_21, D_32 root mean squares of differences over time or place, which do
   * not vanish by chance as a single one does where a front stands in a cell and then
   * jumps:
   *
   *   bar = F sqrt((d^2 + D_21^2)/2) / (r_21^p - 1),
   *
   * p solves D_32/D_21 = r_21^p (r_32^p - 1)/(r_21^p - 1), is at least 0.5, and at most
   * p_s and, as far as the time steps were refined with h, max(1, q_t ln r_t/ln r_21)
   * with the ratio r_t of steps; 1 where they were not. Differences at round-off, 1e-12
   * of S, give that as the bar. Differences whose p is below 0.2 do not converge. Two
   * levels give p = min(1, p_s, cap) and F = 2; where they hardly differ and nothing else
   * tells, at least 0.05 h. One level gives no bar. (The classical grid convergence index
   * of single values covers 83 per cent of the true errors of this program's methods,
   * this one 97; see verification/judge/README.md.)
   *
   * @param coarse_to_fine of falling spacing
   * @param differences D between neighbouring levels, one fewer than levels; NaN where
   * only values are known, of which then d stands for it
   */
  ErrorBar error_bar(std::span<const BarLevel> coarse_to_fine,
                     std::span<const double> differences, const BarRecipe &recipe);
} // namespace meltfront::verification

#endif
