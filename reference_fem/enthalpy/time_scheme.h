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

  /** Of steps by bdf2_step, within its bound. */
  inline constexpr double largest_growth_of_bdf2 = 2.4;

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
      return sooner.empty() && equal_step > steps;
    }

    /** Where the next step ends. */
    double next() const
    {
      return break_is_next() ? breaks.back() : planned();
    }

    void pop()
    {
      const double time = planned();
      const bool at_break = break_is_next();
      // A planned time that misses the breakpoint by round-off gives way.
      if(!at_break || time - breaks.back() <= round_off)
      {
        if(sooner.empty())
          ++equal_step;
        else
          sooner.pop_back();
      }
      if(at_break)
        breaks.pop_back();
    }

    /** Halve the next step, which starts at `now`. */
    void halve(double now)
    {
      sooner.push_back(now + (next() - now) / 2);
    }

    /** Halve the next step until it is no more than so many times the last one. */
    void limit_growth(double before, double now, double growth)
    {
      while(next() - now > growth * (now - before))
        halve(now);
    }

    /** What of it changes in the course of a run (Boost.Serialization). */
    template <class Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &equal_step &sooner &breaks;
    }

  private:
    double planned() const
    {
      return sooner.empty() ? end_of(equal_step) : sooner.back();
    }

    bool break_is_next() const
    {
      return !breaks.empty() && breaks.back() <= planned() + round_off;
    }

    double end_of(long step) const
    {
      return step == steps ? end : start + step * length;
    }

    double start, end, length;
    long steps;
    double round_off;           ///< times nearer to each other are the same (s)
    long equal_step = 1;        ///< the next of the equal steps
    std::vector<double> sooner; ///< ends of parts of it, descending
    std::vector<double> breaks; ///< to come, descending
  };
} // namespace meltfront::reference_fem

#endif
