#ifndef meltfront_reference_fem_fitted_events_profile_h
#define meltfront_reference_fem_fitted_events_profile_h

#include <reference_fem/fitted/fitted_problem.h>

namespace meltfront::reference_fem::fitted
{
  /** T - T_m (K) along the ray of a problem with one phase and no source, and its
   * derivative (K/m). The arguments must outlive the object. */
  class Profile
  {
  public:
    Profile(const FittedProblem &problem, const dealii::Vector<double> &u)
      : problem(problem)
      , u(u)
    {
    }

    double value(double r) const
    {
      return evaluate(r, false);
    }

    double slope(double r) const
    {
      return evaluate(r, true);
    }

  private:
    double evaluate(double r, bool derivative) const;

    const FittedProblem &problem;
    const dealii::Vector<double> &u;
  };
} // namespace meltfront::reference_fem::fitted

#endif
