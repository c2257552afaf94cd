#ifndef meltfront_verification_judge_error_bar_h
#define meltfront_verification_judge_error_bar_h

#include <cases/numbers.h>
#include <verification/record/run_record.h>

#include <span>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** How far differences between levels are believed. */
  struct BarTrust
  {
    double order;           ///< highest that is believed
    double factor;          ///< of safety
    bool all_pairs = false; ///< see BarRecipe
  };

  /** What is known of a method's errors before it runs; see verification/judge/README.md
   * for the runs on which it was chosen. */
  struct BarConstants
  {
    BarTrust front, volume, heat, temperature;
    double order_in_time; ///< of the time scheme in use
    /** Of a quantity's size, below which nothing is told: round-off, or what the method's
     * solver leaves. */
    double floor = 1e-12;
    /** False of a method that is known to converge to something else than the scene's
     * solution: its levels tell nothing of its error. */
    bool consistent = true;
  };

  /** By the run's method, dimension and time scheme. */
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
    /** The largest error of the finest value of which any two neighbouring levels tell,
     * instead of the finest two alone, which may agree by chance. */
    bool all_pairs = false;
    double floor = 1e-12;   ///< of S: differences and bars below it are not believed
    bool consistent = true; ///< else there is no bar
    /** Between neighbouring levels around the place (or time) of a value, where D is over
     * all places: the order is that of all, the width that of the place (of two levels
     * the larger). Empty: D. */
    std::vector<double> local_differences{};
    /** Error of the finest value by its time step, from a run at half the step
     * (error_of_step()); NaN where there is none. */
    double time_error = cases::nan;
  };

  BarRecipe bar_recipe(const BarConstants &constants, const BarTrust &trust, double scale,
                       bool in_time = false);

  /** The error of a value by its time step, from the difference d to a run that took r
   * times as many steps and the root mean square D of that over time or place (NaN: d):
   * sqrt((d^2 + D^2)/2) / (1 - r^-q), Richardson's with the scheme's order q. */
  double error_of_step(double difference, double norm, double ratio_of_steps,
                       double order_in_time);

  /**
   * The error bar of the finest value of a ladder.
   *
   * With levels 1 (the finest), 2, 3, d the difference of two values and D the root mean
   * square of differences over time or place, which does not vanish by chance as a single
   * one does where a front stands in a cell and then jumps:
   *
   *   bar = F (max_k sqrt((d_k^2 + D_k^2)/2) h_1^p / (h_k+1^p - h_k^p) + e_t),
   *
   * k = 1, the finest two, or all neighbours (BarRecipe::all_pairs). p solves
   * D_32/D_21 = r_21^p (r_32^p - 1)/(r_21^p - 1), is at least 0.5 and at most p_s. Where
   * no run at half the step tells the error e_t of the time step, it is zero and p is
   * bounded by what the steps were refined with h, too: max(1, q_t ln r_t/ln r_21) with
   * the ratio r_t of steps; 1 where they were not. No bar is below the floor: differences
   * there have converged. Differences whose p is below 0.2 do not converge. Two levels
   * give p = min(1, p_s, cap) and F of at least 2; where they hardly differ and nothing
   * else tells, at least 0.05 h. One level gives no bar, and no levels of a method that
   * is not consistent do. (The classical grid convergence index of single values covers
   * 83 per cent of the true errors of this program's methods; see
   * verification/judge/README.md.)
   *
   * @param coarse_to_fine of falling spacing
   * @param differences D between neighbouring levels, one fewer than levels; NaN where
   * only values are known, of which then d stands for it
   */
  ErrorBar error_bar(std::span<const BarLevel> coarse_to_fine,
                     std::span<const double> differences, const BarRecipe &recipe);
} // namespace meltfront::verification

#endif
