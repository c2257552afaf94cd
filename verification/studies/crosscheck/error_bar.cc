#include <verification/studies/crosscheck/error_bar.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    constexpr double round_off = 1e-12;

    /** Root mean square of the difference of two levels from one time to another. */
    double difference(const Level &one, const Level &other, std::size_t from,
                      std::size_t to)
    {
      double sum = 0;
      int count = 0;
      for(std::size_t k = from; k <= to; ++k)
        if(const double d = one.values[k] - other.values[k]; std::isfinite(d))
        {
          sum += d * d;
          ++count;
        }
      return count > 0 ? std::sqrt(sum / count) : 0;
    }

    /** p with ratio = r21^p (r32^p - 1)/(r21^p - 1), which rises with p. */
    double observed_order(double ratio, double r21, double r32)
    {
      const auto right_side = [&](double p)
      { return std::pow(r21, p) * (std::pow(r32, p) - 1) / (std::pow(r21, p) - 1); };
      double lower = 1e-3, upper = 20;
      if(ratio <= right_side(lower))
        return 0;
      if(ratio >= right_side(upper))
        return upper;
      for(int i = 0; i < 60; ++i)
      {
        const double middle = (lower + upper) / 2;
        (right_side(middle) < ratio ? lower : upper) = middle;
      }
      return lower;
    }
  } // namespace

  Estimate estimate_at(const std::vector<Level> &coarse_to_fine, std::size_t time,
                       double scale)
  {
    const std::size_t levels = coarse_to_fine.size();
    const Level &finest = coarse_to_fine.back();
    Estimate estimate;
    estimate.value = finest.values[time];
    if(levels < 2)
    {
      estimate.bar = std::numeric_limits<double>::infinity();
      return estimate;
    }
    const Level &second = coarse_to_fine[levels - 2];
    const std::size_t last = finest.values.size() - 1, reach = last / 8;
    const double d = difference(finest, second, time, time);
    const double around = difference(finest, second, time - std::min(time, reach),
                                     std::min(time + reach, last));
    const double a = std::sqrt((d * d + around * around) / 2);
    const double floor = reading_error * scale;
    const double r21 = second.spacing / finest.spacing;
    const double step_ratio = finest.steps / std::max(second.steps, 1.);
    estimate.order = 1;
    if(levels > 2)
    {
      const Level &third = coarse_to_fine[levels - 3];
      const double finer = difference(finest, second, 0, last);
      const double coarser = difference(second, third, 0, last);
      const double observed = finer > 0 ? observed_order(coarser / finer, r21,
                                                         third.spacing / second.spacing)
                                        : highest_order;
      estimate.converging = observed >= 0.2 || coarser <= round_off * scale
                            || std::max(coarser, finer) < floor;
      if(!estimate.converging)
      {
        estimate.order = 0;
        estimate.bar
            = 3 * std::max({finer, coarser, d, difference(second, third, time, time)})
              + floor;
        return estimate;
      }
      const double highest = step_ratio < 1.1 ? 1 : highest_order;
      estimate.order = std::clamp(observed, lowest_order, highest);
    }
    estimate.bar = safety_factor * a / (std::pow(r21, estimate.order) - 1) + floor;
    return estimate;
  }
} // namespace meltfront::verification
