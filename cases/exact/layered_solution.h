#ifndef meltfront_cases_exact_layered_solution_h
#define meltfront_cases_exact_layered_solution_h

#include <cases/exact_solution.h>

#include <vector>

namespace meltfront::cases
{
  /**
   * A solution in one coordinate on a finite domain with any number of fronts, between
   * which solid and liquid alternate from the phase that holds the origin.
   *
   * With one front all is said by front(). With more, front() encloses as much of the
   * phase at the origin as there is anywhere, and depends_on_one_coordinate() is false:
   * methods are compared by the volume of the solid and point by point.
   */
  class LayeredSolution : public ExactSolution
  {
  public:
    /** Where the phases meet (m), ascending, at walls where a front has not yet appeared.
     */
    virtual std::vector<double> fronts(double time) const = 0;

    /** Ends of the domain (m). */
    virtual double inner() const = 0;
    virtual double outer() const = 0;

    bool has_front() const override;
    bool depends_on_one_coordinate() const override;
    double front(double time) const override;

    using ExactSolution::solid_fraction;
    double solid_fraction(double coordinate, double time) const override;

    double solid_volume(double lower, double upper, double time) const override;
    double solid_volume(double time) const override;

    /** Of all fronts, those included that are still at their wall. */
    double front_area(double time) const override;

    /** To the nearest front; negative in the phase that holds the origin. */
    double signed_distance(const Position &position, double time) const override;
  };

  /** The fronts of a solution at a time. */
  std::vector<double> fronts_of(const ExactSolution &solution, double time);
} // namespace meltfront::cases

#endif
