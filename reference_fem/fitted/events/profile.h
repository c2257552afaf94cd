#ifndef meltfront_reference_fem_fitted_events_profile_h
#define meltfront_reference_fem_fitted_events_profile_h

#include <reference_fem/fitted/fitted_problem.h>

namespace meltfront::reference_fem::fitted
{
  /** T - T_m (K) along the ray of a problem at a time, and its derivative (K/m). The
   * arguments must outlive the object. */
  class Profile
  {
  public:
    Profile(const FittedProblem &problem, double time, const dealii::Vector<double> &u);

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
    double time;
    const dealii::Vector<double> &u;
    std::vector<double> faces; ///< of the layers (m)
  };
} // namespace meltfront::reference_fem::fitted

#endif
