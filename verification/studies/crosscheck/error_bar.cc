#include <verification/judge/error_bar.h>
#include <verification/studies/crosscheck/error_bar.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    /** Of the finest levels so many tell of errors. */
    constexpr std::size_t counted_levels = 4;

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

    /** That at a time, together with those around it: a front that stands in a cell makes
     * single differences vanish by chance. */
    double around(const Level &one, const Level &other, std::size_t time)
    {
      const std::size_t last = one.values.size() - 1, reach = last / 8;
      const double here = difference(one, other, time, time);
      const double near = difference(one, other, time - std::min(time, reach),
                                     std::min(time + reach, last));
      return std::sqrt((here * here + near * near) / 2);
    }

    /** The error of the finest level over the difference of two levels, if it falls as
     * h^p. */
    double error_per_difference(const Level &finest, const Level &finer,
                                const Level &coarser, double p)
    {
      return std::pow(finest.spacing, p)
             / (std::pow(coarser.spacing, p) - std::pow(finer.spacing, p));
    }
  } // namespace

  Estimate estimate_at(const std::vector<Level> &coarse_to_fine, std::size_t time,
                       double scale)
  {
    const std::size_t levels = coarse_to_fine.size();
    const Level &finest = coarse_to_fine.back();
    const double floor = reading_error * scale
                         + (finest.misreadings.empty() ? 0 : finest.misreadings[time]);
    Estimate estimate;
    estimate.value = finest.values[time];
    if(levels < 2)
    {
      estimate.bar = std::numeric_limits<double>::infinity();
      return estimate;
    }
    const Level &second = coarse_to_fine[levels - 2];
    estimate.order = lowest_order;
    if(levels > 2)
    {
      const Level &third = coarse_to_fine[levels - 3];
      const std::size_t last = finest.values.size() - 1;
      const double finer = difference(finest, second, 0, last);
      const double coarser = difference(second, third, 0, last);
      const double observed
          = finer > 0 ? observed_order(coarser / finer, second.spacing / finest.spacing,
                                       third.spacing / second.spacing)
                      : highest_order;
      estimate.converging = observed >= 0.2 || std::max(coarser, finer) < floor;
      if(!estimate.converging)
      {
        estimate.order = 0;
        estimate.bar = 3
                           * std::max({finer, coarser, around(finest, second, time),
                                       around(second, third, time)})
                       + floor;
        return estimate;
      }
      estimate.order = std::clamp(observed, lowest_order, highest_order);
    }
    // Where two levels agree at a time, only a third could tell that terms of their
    // errors cancel there.
    const double course
        = levels == 2 ? difference(finest, second, 0, finest.values.size() - 1) : 0;
    double error = 0;
    for(std::size_t i = std::max(levels, counted_levels) - counted_levels; i < levels;
        ++i)
      for(std::size_t j = i + 1; j < levels; ++j)
      {
        const Level &coarser = coarse_to_fine[i], &finer = coarse_to_fine[j];
        error = std::max(
            error, std::max(course, around(finer, coarser, time))
                       * error_per_difference(finest, finer, coarser, estimate.order));
      }
    estimate.bar = safety_factor * error + floor;
    return estimate;
  }
} // namespace meltfront::verification
