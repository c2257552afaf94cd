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
  {
    const double step = (end - start) / steps;
    times.push_back(end);
    for(long i = steps - 1; i > 0; --i)
      times.push_back(start + i * step);
    const double first = times.back() - start;
    for(int i = 1; i <= start_halvings; ++i)
      times.push_back(start + std::ldexp(first, -i));
    for(const double time : breakpoints)
    {
      const auto after = std::ranges::lower_bound(times, time, std::greater<>());
      // A planned time that misses the breakpoint by round-off gives way.
      constexpr double round_off = 1e-12;
      const auto near = [&](double planned)
      { return planned != end && std::abs(planned - time) <= round_off * (end - start); };
      if(after != times.end() && near(*after))
        *after = time;
      else if(after != times.begin() && near(*(after - 1)))
        *(after - 1) = time;
      else if(time > start && time < end)
        times.insert(after, time);
    }
  }
} // namespace meltfront::reference_fem
