#include <verification/record/run_times.h>

#include <algorithm>

namespace meltfront::verification
{
  bool agree_within(const RunTimes &times, double tolerance)
  {
    constexpr std::size_t count = 3;
    std::vector<double> cpu = times.cpu;
    std::ranges::sort(cpu);
    return cpu.size() >= count && cpu[count - 1] <= (1 + tolerance) * cpu[0];
  }

  bool settled(const RunTimes &times)
  {
    constexpr std::size_t fewest = 5, most = 15;
    constexpr double tolerance = 0.03;
    return times.cpu.size() >= most
           || (times.cpu.size() >= fewest && agree_within(times, tolerance));
  }

  bool disturbed(const RunTimes &times)
  {
    constexpr double shared_core = 1.2;
    const auto least = std::ranges::min_element(times.cpu);
    if(least == times.cpu.end())
      return false;
    const auto at = static_cast<std::size_t>(least - times.cpu.begin());
    return times.wall[at] >= shared_core * *least;
  }
} // namespace meltfront::verification
