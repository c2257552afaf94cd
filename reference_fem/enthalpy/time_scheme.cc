#include <reference_fem/enthalpy/time_scheme.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

  StepQueue::StepQueue(double start, double end, long steps, int start_halvings,
                       const std::vector<double> &breakpoints)
    : start(start)
    , end(end)
    , length((end - start) / steps)
    , steps(steps)
    , round_off(1e-12 * (end - start))
  {
    const double first = end_of(1) - start;
    for(int i = 1; i <= start_halvings; ++i)
      sooner.push_back(start + std::ldexp(first, -i));
    for(const double time : breakpoints)
      if(time > start + round_off && time < end - round_off)
        breaks.push_back(time);
    std::ranges::reverse(breaks);
  }
} // namespace meltfront::reference_fem
