#include <reference_fem/enthalpy/time_scheme.h>

#include <cmath>

namespace meltfront::reference_fem
{
  StepFormula backward_euler_step(double now, double next)
  {
    return {now, now, next, next - now, 1, 0};
  }

  StepFormula bdf2_step(double before, double now, double next)
  {
    const double ratio = (next - now) / (now - before);
    const double scale = 1 + 2 * ratio;
    const double weight_before = -ratio * ratio / scale;
    return {
        before,       now, next, (next - now) * (1 + ratio) / scale, 1 - weight_before,
        weight_before};
  }

  StepQueue::StepQueue(double start, double end, long steps, int start_halvings)
    : start(start)
    , end(end)
    , length((end - start) / steps)
    , steps(steps)
  {
    const double first = end_of(1) - start;
    for(int i = 1; i <= start_halvings; ++i)
      sooner.push_back(start + std::ldexp(first, -i));
  }
} // namespace meltfront::reference_fem
