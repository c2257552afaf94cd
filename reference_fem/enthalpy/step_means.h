#ifndef meltfront_reference_fem_enthalpy_step_means_h
#define meltfront_reference_fem_enthalpy_step_means_h

#include <cases/time_integral.h>
#include <reference_fem/enthalpy/time_scheme.h>

#include <span>

namespace meltfront::reference_fem
{
  /**
   * What stands for a field f in a step so that c times it sums up to f's integral over
   * time: with E the integral from the start,
   *
   *   c mean = E(next) - combine(E(now), E(before)).
   */
  class StepMeans
  {
  public:
    StepMeans(const StepFormula &step, cases::StepIntegrals &field)
      : step(step)
      , steady(field.steady())
    {
      values = steady ? field.steady_values() : field.over(step.now, step.next);
      if(!steady && step.weight_before != 0)
        integral_before = field.over(step.before, step.now);
    }

    /** At a point of the integrals. */
    double at(std::size_t point) const
    {
      if(steady)
        return values[point];
      double heat = values[point];
      if(!integral_before.empty())
        heat += step.weight_before * integral_before[point];
      return heat / step.c;
    }

  private:
    const StepFormula &step;
    bool steady;
    std::span<const double> values; ///< or integrals over the step
    std::span<const double> integral_before;
  };
} // namespace meltfront::reference_fem

#endif
