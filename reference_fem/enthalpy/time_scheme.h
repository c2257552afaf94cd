#ifndef meltfront_reference_fem_enthalpy_time_scheme_h
#define meltfront_reference_fem_enthalpy_time_scheme_h

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * An implicit step from `now` to `next`: a quantity X with dX/dt = f obeys
   *
   *   X(next) = combine(X(now), X(before)) + c f(next).
   *
   * Heat, wall heat and source heat all follow this recurrence, so a budget that holds
   * for f holds for the sums to round-off.
   */
  struct StepFormula
  {
    double before = 0, now = 0, next = 0; ///< s
    double c = 0;                         ///< s
    double weight_now = 1, weight_before = 0;

    double combine(double value_now, double value_before) const
    {
      return weight_now * value_now + weight_before * value_before;
    }
  };

  /** Backward Euler: c = dt. */
  StepFormula backward_euler_step(double now, double next);

  /**
   * The two-step backward differentiation formula for unequal steps; with w the step over
   * the last one, c = dt (1 + w)/(1 + 2 w) and the weights (1 + w)^2/(1 + 2 w) and
   * -w^2/(1 + 2 w). Zero-stable for w < 1 + sqrt(2).
   */
  StepFormula bdf2_step(double before, double now, double next);

  /**
   * The times that a run steps to. Steps can be halved; since a halved step is followed
   * by one of at most twice its size, the ratio of steps stays within bdf2_step's bound.
   */
  class StepQueue
  {
  public:
    /**
     * Equal steps, the first of them replaced by start_halvings + 1 steps that double
     * from 2^-start_halvings; steps end at the breakpoints (ascending) too.
     */
    StepQueue(double start, double end, long steps, int start_halvings,
              const std::vector<double> &breakpoints = {});

    bool empty() const
    {
      return times.empty();
    }

    /** Where the next step ends. */
    double next() const
    {
      return times.back();
    }

    void pop()
    {
      times.pop_back();
    }

    /** Halve the next step, which starts at `now`. */
    void halve(double now)
    {
      times.push_back(now + (times.back() - now) / 2);
    }

  private:
    std::vector<double> times; ///< descending
  };
} // namespace meltfront::reference_fem

#endif
