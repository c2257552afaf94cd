#include <verification/judge/error_bar.h>
#include <verification/studies/crosscheck/estimate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace meltfront::verification
{
  namespace
  {
    /** Of the finest levels so many tell of errors. */
    constexpr std::size_t counted_levels = 4;

    /** Root mean square of the difference of two levels from one time to another. */
    double difference(const CourseLevel &one, const CourseLevel &other, std::size_t from,
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

    /** Of two levels around a time. */
    double around(const CourseLevel &one, const CourseLevel &other, std::size_t time)
    {
      const std::size_t last = one.values.size() - 1, reach = last / 8;
      return difference(one, other, time - std::min(time, reach),
                        std::min(time + reach, last));
    }
  } // namespace

  Estimate estimate_at(const std::vector<CourseLevel> &coarse_to_fine, std::size_t time,
                       double scale)
  {
    const std::span<const CourseLevel> levels
        = std::span(coarse_to_fine).last(std::min(counted_levels, coarse_to_fine.size()));
    const CourseLevel &finest = levels.back();
    if(levels.size() < 2)
      return {finest.values[time], std::numeric_limits<double>::infinity()};
    BarRecipe recipe{scale, levels.size() > 2 ? highest_order : order_of_two_levels,
                     highest_order, safety_factor};
    recipe.all_pairs = true;
    recipe.floor = 0;
    recipe.time_error = 0; // The differences hold it.
    std::vector<BarLevel> values;
    std::vector<double> differences;
    for(std::size_t k = 0; k < levels.size(); ++k)
    {
      values.push_back({levels[k].spacing, 0, levels[k].values[time]});
      if(k + 1 == levels.size())
        break;
      differences.push_back(
          difference(levels[k], levels[k + 1], 0, finest.values.size() - 1));
      recipe.local_differences.push_back(around(levels[k], levels[k + 1], time));
    }
    const ErrorBar found = error_bar(values, differences, recipe);
    const double floor = reading_error * scale
                         + (finest.misreadings.empty() ? 0 : finest.misreadings[time]);
    return {found.value, found.bar + floor, found.order, found.converging};
  }
} // namespace meltfront::verification
