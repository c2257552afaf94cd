#include <cases/numbers.h>
#include <verification/measure/formulas/run_statistics.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;
    constexpr std::size_t cubic_points = 4;
    constexpr double steps_before_intermediate = 5, steps_after_intermediate = 4;
  } // namespace

  void ErrorStatistics::add(double error)
  {
    if(std::isnan(error))
      return;
    ++count;
    squares += error * error;
    maximum = std::max(maximum, std::abs(error));
  }

  double ErrorStatistics::root_mean_square() const
  {
    return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : nan;
  }

  double ErrorStatistics::mean_over_time() const
  {
    return count >= fewest_times ? root_mean_square() : nan;
  }

  double ErrorStatistics::largest() const
  {
    return count > 0 ? maximum : nan;
  }

  void FrontCourse::add(double position)
  {
    if(!any)
      first = highest = lowest = position;
    any = true;
    last = position;
    highest = std::max(highest, position);
    lowest = std::min(lowest, position);
    largest_fall = std::max(largest_fall, highest - position);
    largest_rise = std::max(largest_rise, position - lowest);
  }

  double FrontCourse::net_advance() const
  {
    return any ? last - first : nan;
  }

  double FrontCourse::largest_backstep(bool retreats) const
  {
    if(!any)
      return nan;
    return retreats ? largest_rise : largest_fall;
  }

  double interpolated(const std::vector<double> &times, const std::vector<double> &values,
                      double time, double tolerance)
  {
    if(times.empty() || !(time >= times.front() - tolerance)
       || !(time <= times.back() + tolerance))
      return nan;
    const auto after = static_cast<std::size_t>(
        std::lower_bound(times.begin(), times.end(), time) - times.begin());
    for(const std::size_t i : {after, after - 1})
      if(i < times.size() && std::abs(times[i] - time) <= tolerance)
        return values[i];
    const std::size_t points = std::min(cubic_points, times.size());
    const std::size_t wanted = after >= points / 2 ? after - points / 2 : 0;
    const std::size_t first = std::min(wanted, times.size() - points);
    double result = 0;
    for(std::size_t i = first; i < first + points; ++i)
    {
      double factor = values[i];
      for(std::size_t j = first; j < first + points; ++j)
        if(j != i)
          factor *= (time - times[j]) / (times[i] - times[j]);
      result += factor;
    }
    return result;
  }

  SnapshotTimes::SnapshotTimes(std::vector<double> intermediate_times)
    : intermediate_times(std::move(intermediate_times))
  {
  }

  void SnapshotTimes::pass(long step, double time)
  {
    if(step == last_step)
      return;
    step_length = last_step < 0 ? 0 : time - last_time;
    last_step = step;
    last_time = time;
  }

  bool SnapshotTimes::near_one() const
  {
    return std::ranges::any_of(
        intermediate_times,
        [this](double intermediate)
        {
          return last_time >= intermediate - steps_before_intermediate * step_length
                 && last_time <= intermediate + steps_after_intermediate * step_length;
        });
  }
} // namespace meltfront::verification
