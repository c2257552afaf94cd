#ifndef meltfront_cases_time_integral_h
#define meltfront_cases_time_integral_h

#include <cases/scene.h>

#include <span>
#include <vector>

namespace meltfront::cases
{
  /**
   * The mean of a field at a position over a time,
   *
   *   1/(end - begin) integral_begin^end f(position, t) dt,
   *
   * by quadrature on each piece between the field's breakpoints: three points of Gauss,
   * with equal values as they are; else seven of Kronrod, and halves of the piece as long
   * as the two rules disagree by more than 1e-6 of the largest value. Any breakpoint
   * counts, however close to another; a feature that lies between all points and has no
   * breakpoint is not seen. `begin == end` gives the value then.
   */
  class TimeMean
  {
  public:
    explicit TimeMean(Field field);

    double operator()(const Position &position, double begin, double end) const;

    /** Whether time does not matter: a mean costs one call of the field. */
    bool steady() const
    {
      return is_steady;
    }

    const Field &field() const
    {
      return averaged;
    }

  private:
    Field averaged;
    bool is_steady;
  };

  /** Integrals of a field over steps at fixed points; what was evaluated for the last two
   * steps is kept, for formulas of more than one step. */
  class StepIntegrals
  {
  public:
    StepIntegrals(const Field &field, std::vector<Position> points);

    /** The integral over begin..end at each point; valid until the call after the next.
     */
    std::span<const double> over(double begin, double end);

    bool steady() const
    {
      return mean.steady();
    }

    /** Of a field that is steady: its value at each point. */
    std::span<const double> steady_values();

    std::size_t bytes() const;

  private:
    struct Step
    {
      double begin = 0, end = 0;
      std::vector<double> integral;
    };

    TimeMean mean;
    std::vector<Position> points;
    std::array<Step, 2> steps;
    std::size_t latest = 0;
  };

  /** Times within the run at which what the scene prescribes over time may jump or bend,
   * as far as the fields tell: where steps of a high order had better end. Ascending; of
   * those that only round-off parts one. */
  std::vector<double> breakpoints_of(const Scene &scene);

  /** Whether a field has a breakpoint at a time, but for round-off. */
  bool breaks_at(const Field &field, double time);

  /** A time, or that of ascending breakpoints from which only round-off parts it: a step
   * between the two would have no length to speak of. */
  double snap_to_breakpoint(const std::vector<double> &breakpoints, double time);

  /** The first of ascending breakpoints within a step, or its end. */
  double end_of_piece(const std::vector<double> &breakpoints, double begin, double end);

  /** A field's value at the end of a step that began earlier: at a breakpoint that from
   * which it jumps. */
  double value_at_end(const Field &field, const Position &position, double begin,
                      double end);

  /** A field's value at the begin of a step: at a breakpoint that to which it jumps. */
  double value_at_begin(const Field &field, const Position &position, double begin,
                        double end);
} // namespace meltfront::cases

#endif
