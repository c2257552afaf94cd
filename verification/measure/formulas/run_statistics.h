#ifndef meltfront_verification_measure_formulas_run_statistics_h
#define meltfront_verification_measure_formulas_run_statistics_h

#include <vector>

namespace meltfront::verification
{
  /** Errors gathered one by one; NaN is passed over. */
  class ErrorStatistics
  {
  public:
    void add(double error);

    /** Fewer times than that are no average over a run. */
    static constexpr int fewest_times = 50;

    /** Root mean square; NaN for no error at all. */
    double root_mean_square() const;

    /** Root mean square over times; NaN for fewer than fewest_times. */
    double mean_over_time() const;

    /** Largest magnitude; NaN for no error at all. */
    double largest() const;

  private:
    long count = 0;
    double squares = 0;
    double maximum = 0;
  };

  /** How far a front, or the solid's volume, fell back behind where it had been. */
  class FrontCourse
  {
  public:
    void add(double position);

    /** Last position less the first; NaN for no position at all. */
    double net_advance() const;

    /**
     * NaN for no position at all.
     * @param retreats whether physics says that the coordinate of the front falls
     */
    double largest_backstep(bool retreats) const;

  private:
    bool any = false;
    double first = 0, last = 0, highest = 0, lowest = 0;
    double largest_fall = 0, largest_rise = 0; ///< below the highest, above the lowest
  };

  /**
   * The value at a time between samples: the cubic through the two samples before it and
   * the two after it (through the nearest four where one side has fewer, through all if
   * there are no four), and the sample itself where one lies within the tolerance.
   *
   * @param times ascending
   * @return NaN outside the samples
   */
  double interpolated(const std::vector<double> &times, const std::vector<double> &values,
                      double time, double tolerance = 0);

  /**
   * Tells a run which steps lie so near an intermediate time in time that they are wanted
   * for the interpolation to it: those within five steps before it and four behind.
   */
  class SnapshotTimes
  {
  public:
    explicit SnapshotTimes(std::vector<double> intermediate_times);

    /** The state after a step is at this time; steps come in their order, and one that
     * was seen before changes nothing. */
    void pass(long step, double time);

    /** Whether an intermediate time is near the time that was passed last. */
    bool near_one() const;

  private:
    std::vector<double> intermediate_times;
    long last_step = -1;
    double last_time = 0, step_length = 0;
  };
} // namespace meltfront::verification

#endif
