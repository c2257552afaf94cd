#include <verification/run/memory_limit.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    constexpr double unlimited = std::numeric_limits<double>::infinity();

    double mem_available(const std::string &root)
    {
      std::ifstream in(root + "/proc/meminfo");
      for(std::string key; in >> key;)
      {
        double kilobytes = 0;
        if(key == "MemAvailable:" && in >> kilobytes)
          return 1024 * kilobytes;
        in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
      }
      return unlimited;
    }

    /** Version 2 of control groups writes `max` where there is no limit, version 1 a
     * number beyond all memory. */
    double limit_in(const std::string &file)
    {
      double bytes = 0;
      return std::ifstream(file) >> bytes ? bytes : unlimited;
    }
  } // namespace

  double available_memory(const std::string &root)
  {
    return std::min({mem_available(root), limit_in(root + "/sys/fs/cgroup/memory.max"),
                     limit_in(root + "/sys/fs/cgroup/memory/memory.limit_in_bytes")});
  }

  void limit_memory([[maybe_unused]] double bytes, [[maybe_unused]] int threads)
  {
#ifndef MELTFRONT_SANITIZE // sanitizers map far more than they use
    constexpr double stack_of_thread = 16e6;
    const double limit = bytes + stack_of_thread * threads;
    if(!(limit < static_cast<double>(std::numeric_limits<rlim_t>::max() / 2)))
      return;
    rlimit data{};
    getrlimit(RLIMIT_DATA, &data);
    data.rlim_cur = std::min(data.rlim_max, static_cast<rlim_t>(limit));
    setrlimit(RLIMIT_DATA, &data);
#endif
  }
} // namespace meltfront::verification
